"""Processes made by fork and by multiprocessing, each with a node of its own; os._exit."""

import multiprocessing
import os
import sys

import rclpy


def run(name: str) -> None:
    rclpy.init()
    node = rclpy.create_node(name)
    left = [5]
    node.create_timer(0.1, lambda: left.__setitem__(0, left[0] - 1))
    while left[0]:
        rclpy.spin_once(node)
    rclpy.shutdown()


if __name__ == '__main__':
    spawned = multiprocessing.get_context('spawn').Process(target=run, args=('spawned',))
    spawned.start()
    child = os.fork()
    if not child:
        run('forked')
        os._exit(3)
    run('parent')
    spawned.join()
    _, status = os.waitpid(child, 0)
    print('forked ended with', os.waitstatus_to_exitcode(status))
    print('spawned ended with', spawned.exitcode)
    sys.exit(4)
