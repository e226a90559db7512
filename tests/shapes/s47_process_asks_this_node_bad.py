"""A callback waits for a program that waits for what the callback would do next."""

import subprocess

import rclpy
from rclpy.node import Node


class Updater(Node):
    def __init__(self):
        super().__init__('updater')
        self.create_timer(0.5, self.update)

    def update(self):
        child = subprocess.Popen(['cat'], stdin=subprocess.PIPE)
        child.wait()  # waits here
        child.stdin.close()
        print('goes on')


def main():
    rclpy.init()
    rclpy.spin(Updater())


if __name__ == '__main__':
    main()
