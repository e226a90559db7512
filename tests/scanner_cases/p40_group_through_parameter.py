"""P40: node, group and callback go through a helper class."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.node import Node


class Helper:
    def __init__(self, node, group=None):
        node.create_timer(1.0, self.tick, callback_group=group)

    def tick(self):
        pass


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.group = ReentrantCallbackGroup()
        self.first = Helper(self, self.group)
        self.second = Helper(self)
        self.third = Helper(group=MutuallyExclusiveCallbackGroup(), node=self)


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group group REENTRANT
#   group a_default EXCLUSIVE default
#   group tick_3_group EXCLUSIVE
#   timer tick in group every 1
#   timer tick_2 in a_default (Helper.tick) every 1
#   timer tick_3 in tick_3_group (Helper.tick) every 1
