"""P26: made in a while loop: an unknown number."""
# live: no, the number depends on a parameter

import rclpy
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        left = self.declare_parameter('number', 2).value
        while left:
            self.create_timer(1.0, self.tick)
            left -= 1

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
#   timer tick in a_default every 1 count=?
#   ? tick count
