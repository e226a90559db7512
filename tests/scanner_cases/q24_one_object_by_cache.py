"""Point 24: a function that keeps its results gives one node for the same arguments."""

from functools import cache, lru_cache

import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


@lru_cache(maxsize=None)
def shared_node():
    node = Node('hub')
    node.create_timer(1.0, tick)
    return node


@cache
def node_of(name):
    node = Node(name)
    node.create_timer(0.5, tick)
    return node


@lru_cache
class Logbook:
    def __init__(self, node):
        self.timer = node.create_timer(2.0, tick)


def tick():
    pass


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=4)
    for node in (shared_node(), shared_node(), node_of('left'), node_of('right'), node_of('left')):
        executor.add_node(node)
    kept = [Logbook(shared_node()), Logbook(shared_node()), Logbook(node_of('left'))]
    executor.spin()
    return kept


if __name__ == '__main__':
    main()

# expect:
# unit hub_and_2_more: MultiThreadedExecutor x4 spin, main
#   nodes hub, left, right
#   group hub_default EXCLUSIVE default
#   group left_default EXCLUSIVE default
#   group right_default EXCLUSIVE default
#   timer tick in hub_default every 1 node=hub
#   timer tick_2 in hub_default (tick) every 2 node=hub
#   timer tick_3 in left_default (tick) every 0.5 node=left
#   timer tick_4 in left_default (tick) every 2 node=left
#   timer tick_5 in right_default (tick) every 0.5 node=right
