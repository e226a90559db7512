"""A callback sleeps until a flag is set that a callback of its own group sets. Mended."""

import time

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Gate(Node):
    def __init__(self):
        super().__init__('gate')
        self.is_open = False
        self.create_timer(0.5, self.drive_through)
        self.create_timer(0.8, self.on_open, callback_group=MutuallyExclusiveCallbackGroup())

    def drive_through(self):
        while not self.is_open:
            time.sleep(0.05)
        print('goes on')

    def on_open(self):
        self.is_open = True


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Gate())
    executor.spin()


if __name__ == '__main__':
    main()
