"""A callback reads the output of a program that waits for more input."""

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
        child.stdin.write(b'line')
        child.stdin.flush()
        child.stdout.read()  # waits here
        print('goes on')


def main():
    rclpy.init()
    rclpy.spin(Filter())


if __name__ == '__main__':
    main()
