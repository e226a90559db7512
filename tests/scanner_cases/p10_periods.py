"""P10: periods that fold: arithmetic, constants, attributes."""

import rclpy
from rclpy.node import Node


RATE_HZ = 20
PERIOD = 1 / RATE_HZ


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.period = 0.1
        self.create_timer(1 / 20, self.one)
        self.create_timer(PERIOD, self.two)
        self.create_timer(self.period * 2, self.three)
        self.create_timer(1.0 / float(RATE_HZ), self.four)

    def one(self):
        pass

    def two(self):
        pass

    def three(self):
        pass

    def four(self):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer one in a_default every 0.05
#   timer two in a_default every 0.05
#   timer three in a_default every 0.2
#   timer four in a_default every 0.05
