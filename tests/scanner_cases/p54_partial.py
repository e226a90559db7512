"""P54: functools.partial, both ways of importing it."""

import functools
from functools import partial

import rclpy
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_timer(1.0, partial(self.tick, 3))
        self.create_timer(2.0, functools.partial(partial(self.tock, 1), 2))

    def tick(self, number):
        pass

    def tock(self, one, two):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 1
#   timer tock in a_default every 2
