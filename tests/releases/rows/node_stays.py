"""A callback under ``rclpy.spin`` spins for a future: are its node's timers served afterwards?"""

import contextlib
import threading

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.task import Future

PATIENCE_S = 2.0
RUNS = 4

rclpy.init()
node = rclpy.create_node('stayer')
runs = []


def run() -> None:
    runs.append(1)
    if len(runs) == 1:
        future = Future()
        future.set_result(None)
        with contextlib.suppress(RuntimeError):  # some releases refuse, and then it stays too
            rclpy.spin_until_future_complete(node, future)


node.create_timer(0.1, run)
threading.Timer(PATIENCE_S, rclpy.shutdown).start()
with contextlib.suppress(ExternalShutdownException):
    rclpy.spin(node)
print('yes' if len(runs) >= RUNS else 'no', flush=True)
