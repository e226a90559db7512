"""A callback takes a semaphore that only a callback of its own group gives back. Mended."""

import threading

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Charger(Node):
    def __init__(self):
        super().__init__('charger')
        self.places = threading.Semaphore(2)
        self.create_timer(0.2, self.dock)
        self.create_timer(0.3, self.leave, callback_group=MutuallyExclusiveCallbackGroup())

    def dock(self):
        self.places.acquire()
        print('goes on')

    def leave(self):
        self.places.release()


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Charger())
    executor.spin()


if __name__ == '__main__':
    main()
