"""A callback waits for a program whose output nobody reads."""

import subprocess

import rclpy
from rclpy.node import Node


class Lister(Node):
    def __init__(self):
        super().__init__('lister')
        self.create_timer(0.5, self.list_files)

    def list_files(self):
        child = subprocess.Popen(['seq', '200000'], stdout=subprocess.PIPE)
        child.wait()  # waits here
        print('goes on')


def main():
    rclpy.init()
    rclpy.spin(Lister())


if __name__ == '__main__':
    main()
