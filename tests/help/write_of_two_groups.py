"""Callbacks of two groups assign one attribute."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.state = 'stopped'
        self.create_timer(0.1, self.on_start, callback_group=MutuallyExclusiveCallbackGroup())
        self.create_timer(0.1, self.on_stop)

    def on_start(self):
        self.state = 'driving'
        print('goes on')

    def on_stop(self):
        self.state = 'stopped'


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Arm())
    executor.spin()


if __name__ == '__main__':
    main()
