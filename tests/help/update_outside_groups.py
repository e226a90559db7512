"""A timer reads a counter and writes it later; a thread writes it in between."""

import os
import threading
import time

import rclpy
from rclpy.node import Node


class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.count = 0
        self.create_timer(0.1, self.tick)
        threading.Thread(target=self.listen, daemon=True).start()

    def tick(self):
        before = self.count
        time.sleep(0.05)
        if self.count != before:
            print('lost', flush=True)
            os._exit(1)
        self.count = before + 1
        print('goes on')

    def listen(self):
        while rclpy.ok():
            time.sleep(0.02)
            self.count += 10


def main():
    rclpy.init()
    rclpy.spin(Arm())


if __name__ == '__main__':
    main()
