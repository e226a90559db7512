"""P17: a count from the command line is unresolved."""
# live: no, needs an argument

import sys

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



def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=int(sys.argv[1]))
    executor.add_node(A())
    executor.spin()


if __name__ == '__main__':
    main()

# expect:
# unit a: MultiThreadedExecutor x2 spin UNRESOLVED, main
#   group g REENTRANT
#   timer tick in g every 0.5
#   timer tock in g every 0.7
#   ? executor executor
