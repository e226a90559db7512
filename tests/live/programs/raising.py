"""A callback that raises: the program ends with its traceback. Its argument: threads."""

import sys

import rclpy
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor


def tick() -> None:
    raise RuntimeError('the arm is stuck')


rclpy.init()
node = rclpy.create_node('stuck')
node.create_timer(0.01, tick)
threads = int(sys.argv[1])
executor = MultiThreadedExecutor(threads) if threads > 1 else SingleThreadedExecutor()
rclpy.spin(node, executor)
