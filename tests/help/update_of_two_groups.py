"""A callback reads a counter and writes it later; one of another group writes it in between."""

import os
import time

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.count = 0
        self.create_timer(0.1, self.tick, callback_group=MutuallyExclusiveCallbackGroup())
        self.create_timer(0.03, self.on_reset)

    def tick(self):
        before = self.count
        time.sleep(0.05)
        if self.count != before:
            print('lost', flush=True)
            os._exit(1)
        self.count = before + 1
        print('goes on')

    def on_reset(self):
        self.count += 10


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=3)
    executor.add_node(Arm())
    executor.spin()


if __name__ == '__main__':
    main()
