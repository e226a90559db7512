"""Recursion between helpers ends."""

import rclpy
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.depth = 0
        self.create_timer(1.0, self.even)

    def even(self):
        self.depth += 1
        self.odd()

    def odd(self):
        self.even()


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer even in a_default every 1
#     writes A.depth update @14
#     writes A.depth update @15>18>14
