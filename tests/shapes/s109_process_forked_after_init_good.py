"""A process by fork takes a lock that a thread of its parent holds. Mended."""

import threading
import time

import rclpy
from rclpy.node import Node


def compress(lock, chunk):
    with lock:
        return chunk


class Compressor(Node):
    def __init__(self):
        super().__init__('compressor')
        self.lock = threading.Lock()
        threading.Thread(target=self.fill, daemon=True).start()
        self.create_timer(0.5, self.compress)

    def fill(self):
        while rclpy.ok():
            with self.lock:
                time.sleep(0.1)

    def compress(self):
        worker = threading.Thread(target=compress, args=(self.lock, b'chunk'), daemon=True)
        worker.start()
        worker.join()
        print('goes on')


def main():
    rclpy.init()
    rclpy.spin(Compressor())


if __name__ == '__main__':
    main()
