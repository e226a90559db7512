"""On one of several CPUs: has a ``MultiThreadedExecutor`` fewer threads than there are CPUs?"""

import os
import warnings

import rclpy
from rclpy.executors import MultiThreadedExecutor

cpus = os.cpu_count() or 1
os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
rclpy.init()
with warnings.catch_warnings():
    warnings.simplefilter('ignore')
    threads = MultiThreadedExecutor()._executor._max_workers
print('cannot be told' if cpus == 1 else 'yes' if threads < cpus else 'no', flush=True)
