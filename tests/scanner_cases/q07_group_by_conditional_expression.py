"""Point 7: a conditional expression between two groups."""
# live: no, depends on a parameter

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        one = ReentrantCallbackGroup()
        fast = self.declare_parameter('fast', True).value
        self.create_timer(0.5, self.tick, callback_group=one if fast else None)
        self.create_timer(0.6, self.tock, callback_group=one if True else None)

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
#   group unresolved_1 EXCLUSIVE UNRESOLVED
#   group one REENTRANT
#   timer tick in unresolved_1 every 0.5
#   timer tock in one every 0.6
#   ? unresolved_1 group
