"""Point 4: a local variable rebound."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        g = ReentrantCallbackGroup()
        self.create_timer(0.5, self.tick, callback_group=g)
        g = MutuallyExclusiveCallbackGroup()
        self.create_timer(0.6, self.tock, callback_group=g)
        self.create_timer(0.7, self.tack, callback_group=g)

    def tick(self):
        pass

    def tock(self):
        pass

    def tack(self):
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
#   group g REENTRANT
#   group g_2 EXCLUSIVE
#   timer tick in g every 0.5
#   timer tock in g_2 every 0.6
#   timer tack in g_2 every 0.7
