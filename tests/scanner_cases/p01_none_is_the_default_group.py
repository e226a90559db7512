"""P1: callback_group=None and node.default_callback_group are the default group."""

import rclpy
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_timer(0.5, self.one, callback_group=None)
        self.create_timer(0.5, self.two, callback_group=self.default_callback_group)
        self.create_timer(0.5, self.three)

    def one(self):
        pass

    def two(self):
        pass

    def three(self):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer one in a_default every 0.5
#   timer two in a_default every 0.5
#   timer three in a_default every 0.5
