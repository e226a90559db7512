"""Point 6: the default group of one node used by another."""

import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class A(Node):
    def __init__(self, name, group=None):
        super().__init__(name)
        self.create_timer(0.5, self.tick, callback_group=group)

    def tick(self):
        pass


def main():
    rclpy.init()
    one = A('one')
    two = A('two', one.default_callback_group)
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(one)
    executor.add_node(two)
    executor.spin()


if __name__ == '__main__':
    main()

# expect:
# unit one_and_two: MultiThreadedExecutor x2 spin, main
#   nodes one, two
#   group one_default EXCLUSIVE default
#   timer one_tick in one_default (A.tick) every 0.5 node=one
#   timer two_tick in one_default (A.tick) every 0.5 node=two
