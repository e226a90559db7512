"""A callback waits for an event that a callback of its own group sets. Mended."""

import threading

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Gripper(Node):
    def __init__(self):
        super().__init__('gripper')
        self.closed = threading.Event()
        self.create_timer(0.5, self.close)
        self.create_timer(0.7, self.on_closed, callback_group=MutuallyExclusiveCallbackGroup())

    def close(self):
        self.closed.wait()
        self.closed.clear()
        print('goes on')

    def on_closed(self):
        self.closed.set()


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Gripper())
    executor.spin()


if __name__ == '__main__':
    main()
