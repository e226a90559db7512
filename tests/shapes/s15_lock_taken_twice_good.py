"""A callback takes a lock again that it holds, in a helper. Mended."""

import threading

import rclpy
from rclpy.node import Node


class Store(Node):
    def __init__(self):
        super().__init__('store')
        self.lock = threading.RLock()
        self.items = []
        self.create_timer(0.3, self.store)

    def store(self):
        with self.lock:
            self.items.append(1)
            self.trim()
        print('goes on')

    def trim(self):
        with self.lock:
            del self.items[:-10]


def main():
    rclpy.init()
    rclpy.spin(Store())


if __name__ == '__main__':
    main()
