"""A callback waits on a condition that a callback of its own group notifies."""

import threading

import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Hopper(Node):
    def __init__(self):
        super().__init__('hopper')
        self.filled = threading.Condition()
        self.parts = 0
        self.create_timer(0.4, self.take)
        self.create_timer(0.3, self.fill)

    def take(self):
        with self.filled:
            self.filled.wait_for(lambda: self.parts > 1)  # waits here
            self.parts -= 2
        print('goes on')

    def fill(self):
        with self.filled:
            self.parts += 1
            self.filled.notify()


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Hopper())
    executor.spin()


if __name__ == '__main__':
    main()
