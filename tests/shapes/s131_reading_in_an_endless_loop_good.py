"""A thread of its own reads a line after the other in a loop without end."""

import os
import threading

import rclpy
from rclpy.node import Node


class Gauge(Node):
    def __init__(self):
        super().__init__('gauge')
        self.lines, self.device = os.pipe()
        threading.Thread(target=self.read, daemon=True).start()
        self.create_timer(0.2, self.show)

    def show(self):
        os.write(self.device, b'7')
        print('goes on')

    def read(self):
        while rclpy.ok():
            os.read(self.lines, 1)


def main():
    rclpy.init()
    rclpy.spin(Gauge())


if __name__ == '__main__':
    main()
