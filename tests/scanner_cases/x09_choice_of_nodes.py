"""Hard: which node is made depends on the command line: a unit for each."""
# live: no, depends on the command line

import sys

import rclpy
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_timer(0.5, self.tick)

    def tick(self):
        pass


class B(Node):
    def __init__(self):
        super().__init__('b')
        self.create_timer(0.7, self.tock)

    def tock(self):
        pass


def main():
    rclpy.init()
    if len(sys.argv) > 1:
        node = A()
    else:
        node = B()
    rclpy.spin(node)


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin alternative@34.0, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 0.5
# unit b: SingleThreadedExecutor x1 rclpy.spin alternative@34.1, main
#   group b_default EXCLUSIVE default
#   timer tock in b_default every 0.7
