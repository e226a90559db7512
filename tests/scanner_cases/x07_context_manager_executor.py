"""Hard: executors by a list of nodes and try/finally."""

import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class A(Node):
    def __init__(self, name):
        super().__init__(name)
        self.create_timer(0.5, self.tick)

    def tick(self):
        pass


def main():
    rclpy.init()
    nodes = {'one': A('one'), 'two': A('two')}
    executor = MultiThreadedExecutor(num_threads=len(nodes))
    for node in nodes.values():
        executor.add_node(node)
    try:
        executor.spin()
    finally:
        executor.shutdown()
        for node in nodes.values():
            node.destroy_node()


if __name__ == '__main__':
    main()

# expect:
# unit one_and_two: MultiThreadedExecutor x2 spin, main
#   nodes one, two
#   group one_default EXCLUSIVE default
#   group two_default EXCLUSIVE default
#   timer one_tick in one_default (A.tick) every 0.5 node=one
#   timer two_tick in two_default (A.tick) every 0.5 node=two
