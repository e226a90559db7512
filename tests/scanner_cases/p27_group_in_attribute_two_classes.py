"""P27: the same attribute name in two classes is two groups."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.group = MutuallyExclusiveCallbackGroup()
        self.create_timer(0.5, self.tick, callback_group=self.group)

    def tick(self):
        pass


class B(Node):
    def __init__(self):
        super().__init__('b')
        self.group = ReentrantCallbackGroup()
        self.create_timer(0.5, self.tick, callback_group=self.group)

    def tick(self):
        pass


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(A())
    executor.add_node(B())
    executor.spin()


if __name__ == '__main__':
    main()

# expect:
# unit a_and_b: MultiThreadedExecutor x2 spin, main
#   nodes a, b
#   group group EXCLUSIVE
#   group group_2 REENTRANT
#   timer a_tick in group (A.tick) every 0.5 node=a
#   timer b_tick in group_2 (B.tick) every 0.5 node=b
