"""Hard: callbacks looked up by name."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class A(Node):
    def __init__(self):
        super().__init__('a')
        for side in ('left', 'right'):
            self.create_subscription(String, side, getattr(self, f'on_{side}'), 10)

    def on_left(self, msg):
        pass

    def on_right(self, msg):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   subscription on_left in a_default key=left
#   subscription on_right in a_default key=right
