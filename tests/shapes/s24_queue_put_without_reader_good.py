"""A callback fills a bounded queue whose reader thread has ended after an error. Mended."""

import queue
import threading

import rclpy
from rclpy.node import Node


class Recorder(Node):
    def __init__(self):
        super().__init__('recorder')
        self.frames = queue.Queue(maxsize=5)
        threading.Thread(target=self.write, daemon=True).start()
        self.create_timer(0.1, self.record)

    def record(self):
        self.frames.put(self.get_clock().now())
        print('goes on')

    def write(self):
        while True:
            self.frames.get()


def main():
    rclpy.init()
    rclpy.spin(Recorder())


if __name__ == '__main__':
    main()
