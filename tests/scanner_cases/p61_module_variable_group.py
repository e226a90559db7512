"""Point 6: a module variable is one group for all nodes."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


GROUP = MutuallyExclusiveCallbackGroup()


class A(Node):
    def __init__(self, name):
        super().__init__(name)
        self.create_timer(1.0, self.tick, callback_group=GROUP)

    def tick(self):
        pass


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(A('one'))
    executor.add_node(A('two'))
    executor.spin()


if __name__ == '__main__':
    main()

# expect:
# unit one_and_two: MultiThreadedExecutor x2 spin, main
#   nodes one, two
#   group GROUP EXCLUSIVE
#   timer one_tick in GROUP (A.tick) every 1 node=one
#   timer two_tick in GROUP (A.tick) every 1 node=two
