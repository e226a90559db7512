"""A callback under ``rclpy.spin`` spins: does rclpy refuse?"""

import contextlib
import threading

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException

PATIENCE_S = 0.6

rclpy.init()
node = rclpy.create_node('spinner')
group = ReentrantCallbackGroup()
told = []


def spin() -> None:
    spinning.cancel()
    try:
        rclpy.spin_once(node)
    except RuntimeError:
        told.append('yes')
    else:
        told.append('no')


def tick() -> None:
    pass


spinning = node.create_timer(0.1, spin, callback_group=group)
node.create_timer(0.05, tick, callback_group=group)
threading.Timer(PATIENCE_S, rclpy.shutdown).start()
with contextlib.suppress(ExternalShutdownException):
    rclpy.spin(node)
print(told[0], flush=True)
