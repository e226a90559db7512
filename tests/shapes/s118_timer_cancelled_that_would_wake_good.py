"""A callback cancels the timer that would set the event it waits for. Mended."""

import threading

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Feeder(Node):
    def __init__(self):
        super().__init__('feeder')
        self.fed = threading.Event()
        self.clock_timer = self.create_timer(
            0.4, self.on_time, callback_group=MutuallyExclusiveCallbackGroup()
        )
        self.create_timer(0.5, self.feed)

    def on_time(self):
        self.fed.set()

    def feed(self):
        self.fed.clear()
        self.fed.wait()
        print('goes on')


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Feeder())
    executor.spin()


if __name__ == '__main__':
    main()
