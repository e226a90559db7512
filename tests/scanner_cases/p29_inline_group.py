"""P29: every inline constructor makes a group of its own."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_timer(1.0, self.f, callback_group=MutuallyExclusiveCallbackGroup())
        self.create_timer(1.0, self.h, callback_group=MutuallyExclusiveCallbackGroup())

    def f(self):
        pass

    def h(self):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group f_group EXCLUSIVE
#   group h_group EXCLUSIVE
#   timer f in f_group every 1
#   timer h in h_group every 1
