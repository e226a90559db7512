"""A callback reads the output of a program that waits for more input. Mended."""

import subprocess

import rclpy
from rclpy.node import Node


class Filter(Node):
    def __init__(self):
        super().__init__('filter')
        self.child = None
        self.create_timer(0.5, self.convert)

    def convert(self):
        child = subprocess.Popen(['cat'], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        child.communicate(b'line')
        print('goes on')


def main():
    rclpy.init()
    rclpy.spin(Filter())


if __name__ == '__main__':
    main()
