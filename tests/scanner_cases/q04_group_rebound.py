"""Point 4: a group rebound between two calls: the later call uses the later object."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.g = MutuallyExclusiveCallbackGroup()
        self.create_timer(0.5, self.tick, callback_group=self.g)
        self.g = ReentrantCallbackGroup()
        self.create_timer(0.6, self.tock, callback_group=self.g)

    def tick(self):
        pass

    def tock(self):
        pass


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(A())
    executor.spin()


if __name__ == '__main__':
    main()

# expect:
# unit a: MultiThreadedExecutor x2 spin, main
#   group g EXCLUSIVE
#   group g_2 REENTRANT
#   timer tick in g every 0.5
#   timer tock in g_2 every 0.6
