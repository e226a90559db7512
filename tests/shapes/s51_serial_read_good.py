"""A callback reads from a serial line that is silent. Mended."""

import os
import select

import rclpy
from rclpy.node import Node


class Imu(Node):
    def __init__(self):
        super().__init__('imu')
        self.device, self.line = os.openpty()
        self.create_timer(0.3, self.read)

    def read(self):
        ready, _, _ = select.select([self.line], [], [], 0.05)
        if ready:
            os.read(self.line, 64)
        print('goes on')


def main():
    rclpy.init()
    rclpy.spin(Imu())


if __name__ == '__main__':
    main()
