"""Spins a node by ``rclpy.spin_once``; each 20 runs it makes a node and an executor anew."""

import gc

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node

RUNS = 100
EVERY = 20


class Counting(Node):
    """Counts its runs."""

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.runs = 0
        self.create_timer(0.002, self.count)

    def count(self) -> None:
        self.runs += 1


def serve_another() -> None:
    helper = Counting('helper')
    executor = SingleThreadedExecutor()
    executor.add_node(helper)
    while helper.runs < 2:
        executor.spin_once()
    executor.remove_node(helper)
    executor.shutdown()
    helper.destroy_node()


rclpy.init()
node = Counting('spun')
served = 0
while node.runs < RUNS:
    rclpy.spin_once(node)
    if node.runs >= EVERY * (served + 1):
        served += 1
        serve_another()
# A node that refers to itself goes only now.
gc.collect()
print('served', served)
rclpy.shutdown()
