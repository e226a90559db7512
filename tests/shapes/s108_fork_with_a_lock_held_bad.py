"""A callback forks while a thread holds the lock that the child takes."""

import os
import threading
import time

import rclpy
from rclpy.node import Node


class Archiver(Node):
    def __init__(self):
        super().__init__('archiver')
        self.lock = threading.Lock()
        threading.Thread(target=self.collect, daemon=True).start()
        self.create_timer(0.5, self.archive)

    def collect(self):
        while rclpy.ok():
            with self.lock:
                time.sleep(0.1)

    def archive(self):
        child = os.fork()
        if child == 0:
            with self.lock:
                os._exit(0)
        os.waitpid(child, 0)  # waits here
        print('goes on')


def main():
    rclpy.init()
    rclpy.spin(Archiver())


if __name__ == '__main__':
    main()
