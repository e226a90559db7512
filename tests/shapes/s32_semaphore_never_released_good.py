"""A callback takes a semaphore and gives it back on one of its two ways only. Mended."""

import threading

import rclpy
from rclpy.node import Node


class Loader(Node):
    def __init__(self):
        super().__init__('loader')
        self.slots = threading.BoundedSemaphore(2)
        self.count = 0
        self.create_timer(0.2, self.load)

    def load(self):
        with self.slots:
            self.count += 1
        print('goes on')


def main():
    rclpy.init()
    rclpy.spin(Loader())


if __name__ == '__main__':
    main()
