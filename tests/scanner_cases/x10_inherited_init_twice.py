"""Hard: a subclass that sets the group before the base class uses it."""

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Base(Node):
    group = None

    def __init__(self, name):
        super().__init__(name)
        self.create_timer(0.5, self.tick, callback_group=self.group)

    def tick(self):
        pass


class Plain(Base):
    pass


class Grouped(Base):
    group = ReentrantCallbackGroup()


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Plain('plain'))
    executor.add_node(Grouped('grouped'))
    executor.spin()


if __name__ == '__main__':
    main()

# expect:
# unit plain_and_grouped: MultiThreadedExecutor x2 spin, main
#   nodes plain, grouped
#   group plain_default EXCLUSIVE default
#   group group REENTRANT
#   timer plain_tick in plain_default (Base.tick) every 0.5 node=plain
#   timer grouped_tick in group (Base.tick) every 0.5 node=grouped
