"""P61, point 6: a group as class attribute is one for all instances."""

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class A(Node):
    G = ReentrantCallbackGroup()

    def __init__(self, name):
        super().__init__(name)
        self.create_timer(1.0, self.tick, callback_group=self.G)

    def tick(self):
        pass


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(A('one'))
    executor.add_node(A('two'))
    executor.spin()


if __name__ == '__main__':
    main()

# expect:
# unit one_and_two: MultiThreadedExecutor x2 spin, main
#   nodes one, two
#   group G REENTRANT
#   timer one_tick in G (A.tick) every 1 node=one
#   timer two_tick in G (A.tick) every 1 node=two
