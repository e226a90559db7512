"""Two callbacks in the default group on more threads than they can use; a third group is empty."""

import time

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.group = MutuallyExclusiveCallbackGroup()
        self.create_timer(0.2, self.control)
        self.create_timer(0.9, self.report)

    def control(self):
        print('goes on')

    def report(self):
        time.sleep(0.6)


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(Arm())
    executor.spin()


if __name__ == '__main__':
    main()
