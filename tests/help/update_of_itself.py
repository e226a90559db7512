"""Two runs of one callback read a counter, and each writes it later."""

import os
import time

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.frames = 0
        self.create_timer(0.05, self.on_image, callback_group=ReentrantCallbackGroup())

    def on_image(self):
        before = self.frames
        time.sleep(0.12)
        if self.frames != before:
            print('lost', flush=True)
            os._exit(1)
        self.frames = before + 1
        print('goes on')


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=3)
    executor.add_node(Arm())
    executor.spin()


if __name__ == '__main__':
    main()
