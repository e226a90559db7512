"""A callback forks while a thread holds the lock that the child takes. Mended."""

import subprocess
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
        child = subprocess.Popen(['true'])
        child.wait()
        print('goes on')


def main():
    rclpy.init()
    rclpy.spin(Archiver())


if __name__ == '__main__':
    main()
