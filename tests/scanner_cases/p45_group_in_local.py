"""P45: groups in local variables."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        group = ReentrantCallbackGroup()
        other = MutuallyExclusiveCallbackGroup()
        self.create_timer(0.5, self.tick, callback_group=group)
        self.create_timer(0.6, self.tock, callback_group=other)
        self.create_timer(0.7, self.tack, callback_group=group)

    def tick(self):
        pass

    def tock(self):
        pass

    def tack(self):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group group REENTRANT
#   group other EXCLUSIVE
#   timer tick in group every 0.5
#   timer tock in other every 0.6
#   timer tack in group every 0.7
