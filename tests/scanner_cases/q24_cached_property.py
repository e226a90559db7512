"""Point 24: a cached property gives one group, however often it is asked."""

from functools import cached_property

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_timer(1.0, self.tick, callback_group=self.group)
        self.create_timer(2.0, self.tock, callback_group=self.group)

    @cached_property
    def group(self):
        return MutuallyExclusiveCallbackGroup()

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
#   group tick_group EXCLUSIVE
#   timer tick in tick_group every 1
#   timer tock in tick_group every 2
