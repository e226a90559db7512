"""Does the thread that spins a pool give way once it has handed over a callback?"""

import os
import threading
import time
from collections.abc import Callable
from typing import Any

import rclpy
from rclpy.executors import MultiThreadedExecutor

RUNS = 5
given_way = set()


def noting(function: Callable[..., Any]) -> Callable[..., Any]:
    def noted(*seconds: float) -> Any:
        if seconds in ((), (0,)):
            given_way.add(threading.current_thread())
        return function(*seconds)

    return noted


os.sched_yield = noting(os.sched_yield)
time.sleep = noting(time.sleep)
rclpy.init()
node = rclpy.create_node('pool')
executor = MultiThreadedExecutor(num_threads=2)
executor.add_node(node)
runs = []
node.create_timer(0.05, lambda: runs.append(1))
while len(runs) < RUNS:
    executor.spin_once(timeout_sec=1.0)
print('yes' if threading.main_thread() in given_way else 'no', flush=True)
os._exit(0)
