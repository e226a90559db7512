"""P26: a known but long loop is counted."""
# live: no, counted, not listed

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class A(Node):
    def __init__(self):
        super().__init__('a')
        for number in range(200):
            self.create_subscription(String, f'joint_{number}', self.on_joint, 10)

    def on_joint(self, msg):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   subscription on_joint in a_default key=? count=200
#   ? on_joint topic
