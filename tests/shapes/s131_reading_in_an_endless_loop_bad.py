"""A timer reads a line after the other in a loop without end, on the only thread."""

import os

import rclpy
from rclpy.node import Node


class Gauge(Node):
    def __init__(self):
        super().__init__('gauge')
        self.lines, self.device = os.pipe()
        self.create_timer(0.2, self.read)
        self.create_timer(0.2, self.show)

    def show(self):
        os.write(self.device, b'7')
        print('goes on')

    def read(self):
        while rclpy.ok():
            os.read(self.lines, 1)  # waits here


def main():
    rclpy.init()
    rclpy.spin(Gauge())


if __name__ == '__main__':
    main()
