"""P17: a module constant as thread count."""

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.g = ReentrantCallbackGroup()
        self.create_timer(0.5, self.tick, callback_group=self.g)
        self.create_timer(0.7, self.tock, callback_group=self.g)

    def tick(self):
        pass

    def tock(self):
        pass


THREADS = 2 + 1


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=THREADS)
    executor.add_node(A())
    executor.spin()


if __name__ == '__main__':
    main()

# expect:
# unit a: MultiThreadedExecutor x3 spin, main
#   group g REENTRANT
#   timer tick in g every 0.5
#   timer tock in g every 0.7
