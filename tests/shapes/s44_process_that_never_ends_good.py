"""A callback runs a program that does not end by itself. Mended."""

import subprocess

import rclpy
from rclpy.node import Node


class Tail(Node):
    def __init__(self):
        super().__init__('tail')
        self.create_timer(0.5, self.read)

    def read(self):
        subprocess.run(['tail', '/dev/null'])
        print('goes on')


def main():
    rclpy.init()
    rclpy.spin(Tail())


if __name__ == '__main__':
    main()
