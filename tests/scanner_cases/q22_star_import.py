"""Point 22: star imports."""

import rclpy
from rclpy.callback_groups import *
from rclpy.executors import *
from rclpy.node import *


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_timer(0.5, self.tick, callback_group=ReentrantCallbackGroup())

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
#   group tick_group REENTRANT
#   timer tick in tick_group every 0.5
