"""P57: a callback made by a factory is the function that the factory returns."""

import rclpy
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_timer(1.0, self.make_cb('x'))
        self.create_timer(2.0, self.make_cb('y'))

    def make_cb(self, name):
        def on_timer():
            self.last = name

        return on_timer


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer on_timer in a_default every 1
#     writes A.last @15
#   timer on_timer_2 in a_default (A.make_cb.<locals>.on_timer) every 2
#     writes A.last @15
