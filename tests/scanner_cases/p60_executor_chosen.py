"""P60: an executor chosen by an expression."""
# live: no, depends on the command line

import sys

import rclpy
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_timer(0.5, self.tick)

    def tick(self):
        pass


def main():
    rclpy.init()
    many = len(sys.argv) > 1
    executor = MultiThreadedExecutor(num_threads=2) if many else SingleThreadedExecutor()
    executor.add_node(A())
    executor.spin()


if __name__ == '__main__':
    main()

# expect:
# unit a: MultiThreadedExecutor x2 spin alternative@25.0, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 0.5
# unit a: SingleThreadedExecutor x1 spin alternative@25.1, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 0.5
