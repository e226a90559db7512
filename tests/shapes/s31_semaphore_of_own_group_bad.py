"""A callback takes a semaphore that only a callback of its own group gives back."""

import threading

import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Charger(Node):
    def __init__(self):
        super().__init__('charger')
        self.places = threading.Semaphore(2)
        self.create_timer(0.2, self.dock)
        self.create_timer(1.0, self.leave)

    def dock(self):
        self.places.acquire()  # waits here
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
