"""P14: storing an executor in ``node.executor`` adds the node to it."""

import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_timer(1.0, self.tick)

    def tick(self):
        pass


def main():
    rclpy.init()
    node = A()
    executor = MultiThreadedExecutor(num_threads=3)
    node.executor = executor
    executor.spin()


if __name__ == '__main__':
    main()

# expect:
# unit a: MultiThreadedExecutor x3 spin, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 1
