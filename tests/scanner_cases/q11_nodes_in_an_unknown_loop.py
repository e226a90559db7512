"""Point 11: nodes made in a loop of unknown length."""
# live: no, the number depends on the command line

import sys

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node


class A(Node):
    def __init__(self, name):
        super().__init__(name)
        self.create_timer(0.5, self.tick)

    def tick(self):
        pass


def main():
    rclpy.init()
    executor = SingleThreadedExecutor()
    for name in sys.argv[1:]:
        executor.add_node(A(name))
    executor.spin()


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 spin, main
#   group a_default EXCLUSIVE default count=?
#   timer tick in a_default every 0.5 count=?
#   ? tick count
#   ? a_default count
#   ? a node_name
