"""P60: the class of an executor chosen by a statement."""
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
    if many:
        chosen = MultiThreadedExecutor
    else:
        chosen = SingleThreadedExecutor
    executor = chosen()
    executor.add_node(A())
    executor.spin()


if __name__ == '__main__':
    main()

# expect:
# unit a: MultiThreadedExecutor xdefault spin alternative@29.0, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 0.5
# unit a: SingleThreadedExecutor x1 spin alternative@29.1, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 0.5
