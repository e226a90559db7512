"""A callback waits three times for a second, and delays another of its group. Mended."""

import threading

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Arbiter(Node):
    def __init__(self):
        super().__init__('arbiter')
        self.asked = threading.Event()
        self.create_timer(0.2, self.beat)
        group = MutuallyExclusiveCallbackGroup()
        self.create_timer(0.1, self.arbitrate, callback_group=group)

    def arbitrate(self):
        for _ in range(3):
            self.asked.wait(timeout=1.0)

    def beat(self):
        print('goes on')


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Arbiter())
    executor.spin()


if __name__ == '__main__':
    main()
