"""A thread and a callback take two locks in opposite order."""

import threading
import time

import rclpy
from rclpy.node import Node


class Store(Node):
    def __init__(self):
        super().__init__('store')
        self.index, self.data = threading.Lock(), threading.Lock()
        threading.Thread(target=self.compact, daemon=True).start()
        self.create_timer(0.1, self.insert)

    def compact(self):
        while rclpy.ok():
            with self.data:
                time.sleep(0.05)
                with self.index:  # waits here
                    time.sleep(0.01)

    def insert(self):
        with self.index:
            time.sleep(0.05)
            with self.data:  # waits here
                print('goes on')


def main():
    rclpy.init()
    rclpy.spin(Store())


if __name__ == '__main__':
    main()
