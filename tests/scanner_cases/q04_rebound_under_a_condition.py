"""Points 4, 7: rebound under a condition: unresolved, one of two."""
# live: no, depends on a parameter

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        g = ReentrantCallbackGroup()
        if self.declare_parameter('safe', True).value:
            g = MutuallyExclusiveCallbackGroup()
        self.create_timer(0.5, self.tick, callback_group=g)

    def tick(self):
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
#   group unresolved_1 EXCLUSIVE UNRESOLVED
#   timer tick in unresolved_1 every 0.5
#   ? unresolved_1 group
