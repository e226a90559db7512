"""P48: explicit groups, but only one thread."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_timer(0.5, self.tick, callback_group=ReentrantCallbackGroup())
        self.create_timer(0.7, self.tock, callback_group=MutuallyExclusiveCallbackGroup())

    def tick(self):
        pass

    def tock(self):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group tick_group REENTRANT
#   group tock_group EXCLUSIVE
#   timer tick in tick_group every 0.5
#   timer tock in tock_group every 0.7
