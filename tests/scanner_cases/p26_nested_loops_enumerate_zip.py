"""P26: enumerate, zip and nested loops."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class A(Node):
    def __init__(self):
        super().__init__('a')
        for index, name in enumerate(['x', 'y']):
            self.create_subscription(String, f'{name}{index}', self.on_any, 10)
        for side, period in zip(('left', 'right'), (0.5, 1.0)):
            for part in ('arm', 'leg'):
                self.create_subscription(String, f'{side}/{part}', self.on_part, 10)

    def on_any(self, msg):
        pass

    def on_part(self, msg):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   subscription x0_on_any in a_default (A.on_any) key=x0
#   subscription y1_on_any in a_default (A.on_any) key=y1
#   subscription left_arm_on_part in a_default (A.on_part) key=left/arm
#   subscription left_leg_on_part in a_default (A.on_part) key=left/leg
#   subscription right_arm_on_part in a_default (A.on_part) key=right/arm
#   subscription right_leg_on_part in a_default (A.on_part) key=right/leg
