"""P60: which executor depends on a condition: two units, alternatives."""
# live: no, depends on the command line

import sys

import rclpy
from rclpy.executors import MultiThreadedExecutor
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
        self.create_timer(0.5, self.tick)

    def tick(self):
        pass


def main():
    rclpy.init()
    node = A()
    if len(sys.argv) > 1:
        executor = MultiThreadedExecutor(num_threads=2)
        executor.add_node(node)
        executor.spin()
    else:
        rclpy.spin(node)


if __name__ == '__main__':
    main()

# expect:
# unit a: MultiThreadedExecutor x2 spin alternative@32.0, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 0.5
# unit a: SingleThreadedExecutor x1 rclpy.spin alternative@32.1, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 0.5
# unit b: no executor
#   group b_default EXCLUSIVE default
#   timer tick in b_default every 0.5
#   ? executor executor
