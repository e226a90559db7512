"""P12: a group that is made and kept, and that no entity is given."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.forgotten = ReentrantCallbackGroup()
        self.used = MutuallyExclusiveCallbackGroup()
        self.handed_out = MutuallyExclusiveCallbackGroup()
        self.perhaps = MutuallyExclusiveCallbackGroup()
        self.by_name = MutuallyExclusiveCallbackGroup()
        self.create_timer(1.0, self.tick)
        self.create_timer(2.0, self.tick, callback_group=self.used)

    def tick(self):
        pass

    def never_called(self, somebody):
        somebody.take(self.perhaps, getattr(self, 'by_name'), self.handed_out)


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   group used EXCLUSIVE
#   group forgotten REENTRANT
#   timer tick in a_default every 1
#   timer tick_2 in used (A.tick) every 2
