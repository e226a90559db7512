"""
A callback waits for another one, in a pool that has as many threads as there are CPUs.

CPUs: 1
"""

import threading

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Barrier(Node):
    def __init__(self):
        super().__init__('barrier')
        group = ReentrantCallbackGroup()
        self.opened = threading.Event()
        self.once = self.create_timer(0.3, self.wait, callback_group=group)
        self.other = self.create_timer(0.6, self.open, callback_group=group)

    def wait(self):
        self.once.cancel()
        print('waiting', flush=True)
        self.opened.wait()
        print('opened', flush=True)

    def open(self):
        self.other.cancel()
        self.opened.set()


def main():
    rclpy.init()
    # differs: threads-by-affinity
    executor = MultiThreadedExecutor()
    executor.add_node(Barrier())
    executor.spin()


if __name__ == '__main__':
    main()
