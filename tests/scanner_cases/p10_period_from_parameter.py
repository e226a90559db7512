"""P10: a period from a parameter is not known."""

import rclpy
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        rate = self.declare_parameter('rate', 10.0).value
        self.create_timer(1.0 / rate, self.tick)

    def tick(self):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 0.1 ASSUMED
