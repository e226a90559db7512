"""A condition is notified once, before anybody waits on it. Mended."""

import threading

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Starter(Node):
    def __init__(self):
        super().__init__('starter')
        self.ready = threading.Condition()
        self.is_ready = False
        self.create_timer(1.0, self.start, callback_group=MutuallyExclusiveCallbackGroup())
        self.once = self.create_timer(0.2, self.prepare)

    def prepare(self):
        self.once.cancel()
        with self.ready:
            self.is_ready = True
            self.ready.notify_all()

    def start(self):
        with self.ready:
            while not self.is_ready:
                self.ready.wait()
        print('goes on')


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Starter())
    executor.spin()


if __name__ == '__main__':
    main()
