"""Processes made by fork and by multiprocessing, each with a node of its own; os._exit."""

import multiprocessing
import os
import sys
import time
import warnings
from pathlib import Path

import rclpy

# The hook wraps it when it is imported; what is forked has it wrapped already.
import rclpy.executors

# Python 3.12 and later name the process when there are threads, and rclpy has some.
warnings.simplefilter('ignore', DeprecationWarning)


def run(name: str) -> None:
    rclpy.init()
    node = rclpy.create_node(name)
    left = [5]
    node.create_timer(0.1, lambda: left.__setitem__(0, left[0] - 1))
    while left[0]:
        rclpy.spin_once(node)
    rclpy.shutdown()


def await_recording() -> None:
    """With the hook, wait for its files: nothing is written after ``os._exit``."""
    folder = os.environ.get('ROS2CC_LIVE_DIR')
    kinds = ['events', 'json'] if os.environ.get('ROS2CC_LIVE_TRACE') == '1' else ['json']
    while folder and not all(list(Path(folder).glob(f'{os.getpid()}-*.{k}')) for k in kinds):
        time.sleep(0.01)


if __name__ == '__main__':
    spawned = multiprocessing.get_context('spawn').Process(target=run, args=('spawned',))
    spawned.start()
    child = os.fork()
    if not child:
        run('forked')
        await_recording()
        os._exit(3)
    run('parent')
    spawned.join()
    _, status = os.waitpid(child, 0)
    print('forked ended with', os.waitstatus_to_exitcode(status))
    print('spawned ended with', spawned.exitcode)
    sys.exit(4)
