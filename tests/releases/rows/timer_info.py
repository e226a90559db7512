"""A timer whose callback has a parameter for the times of the call: does it get them?"""

import os
import threading

import rclpy

try:
    from rclpy.timer import TimerInfo
except ImportError:
    print('no', flush=True)
    os._exit(0)

PATIENCE_S = 5.0

rclpy.init()
node = rclpy.create_node('informed')
told = []


def tick(info: TimerInfo) -> None:
    told.append(info.actual_call_time.nanoseconds > 0)


node.create_timer(0.05, tick)
threading.Timer(PATIENCE_S, lambda: os._exit(1)).start()
try:
    while not told:
        rclpy.spin_once(node)
except TypeError:
    told.append(False)
print('yes' if told[0] else 'no', flush=True)
os._exit(0)
