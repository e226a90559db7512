"""Point 1: an executor that is filled and that nobody spins."""

import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_timer(0.5, self.tick)

    def tick(self):
        pass


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: MultiThreadedExecutor x4 not spun UNRESOLVED, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 0.5
#   ? executor executor
# warning executor-not-spun @19
