"""Point 6: a group handed to two nodes stays one group."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class A(Node):
    def __init__(self, name, group):
        super().__init__(name)
        self.create_timer(0.5, self.tick, callback_group=group)

    def tick(self):
        pass


def main():
    rclpy.init()
    group = MutuallyExclusiveCallbackGroup()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(A('one', group))
    executor.add_node(A('two', group))
    executor.spin()


if __name__ == '__main__':
    main()

# expect:
# unit one_and_two: MultiThreadedExecutor x2 spin, main
#   nodes one, two
#   group group EXCLUSIVE
#   timer one_tick in group (A.tick) every 0.5 node=one
#   timer two_tick in group (A.tick) every 0.5 node=two
