"""Point 3: the same group through an alias."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.a = MutuallyExclusiveCallbackGroup()
        b = self.a
        self.create_timer(0.5, self.tick, callback_group=self.a)
        self.create_timer(0.6, self.tock, callback_group=b)

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
#   group a_2 EXCLUSIVE
#   timer tick in a_2 every 0.5
#   timer tock in a_2 every 0.6
