"""P44: many threads, one group."""

import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_timer(0.5, self.tick)
        self.create_timer(0.7, self.tock)

    def tick(self):
        pass

    def tock(self):
        pass


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(A())
    executor.spin()


if __name__ == '__main__':
    main()

# expect:
# unit a: MultiThreadedExecutor x4 spin, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 0.5
#   timer tock in a_default every 0.7
