"""A callback asks whether an object is there, and uses it when it is gone."""

import time

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.goal = None
        self.create_timer(0.1, self.check, callback_group=MutuallyExclusiveCallbackGroup())
        self.create_timer(0.07, self.on_stop)

    def check(self):
        if self.goal is not None:
            time.sleep(0.1)
            self.goal.append('step')
        self.goal = []
        print('goes on')

    def on_stop(self):
        self.goal = None


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Arm())
    executor.spin()


if __name__ == '__main__':
    main()
