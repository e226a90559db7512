"""``rclpy.shutdown()`` in a callback under ``rclpy.spin``: does the spin end?"""

import contextlib
import os
import threading

import rclpy
from rclpy.executors import ExternalShutdownException

PATIENCE_S = 5.0

rclpy.init()
node = rclpy.create_node('stopper')
over = threading.Event()


def spin() -> None:
    with contextlib.suppress(ExternalShutdownException):
        rclpy.spin(node)
    over.set()


node.create_timer(0.05, rclpy.shutdown)
threading.Thread(target=spin, daemon=True).start()
print('yes' if over.wait(PATIENCE_S) else 'no', flush=True)
os._exit(0)
