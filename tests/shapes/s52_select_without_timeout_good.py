"""A callback selects without a time-out on files where nothing comes. Mended."""

import os
import select

import rclpy
from rclpy.node import Node


class Mixer(Node):
    def __init__(self):
        super().__init__('mixer')
        self.reader, self.writer = os.pipe()
        self.create_timer(0.3, self.poll)

    def poll(self):
        select.select([self.reader], [], [], 0.05)
        print('goes on')


def main():
    rclpy.init()
    rclpy.spin(Mixer())


if __name__ == '__main__':
    main()
