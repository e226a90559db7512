"""A thread sleeps on simulated time that nobody publishes. Mended."""

import threading

import rclpy
from rclpy.duration import Duration
from rclpy.node import Node


class Sweeper(Node):
    def __init__(self):
        super().__init__('sweeper')
        threading.Thread(target=self.sweep, daemon=True).start()

    def sweep(self):
        while rclpy.ok():
            self.get_clock().sleep_for(Duration(seconds=0.2))
            print('goes on')


def main():
    rclpy.init()
    rclpy.spin(Sweeper())


if __name__ == '__main__':
    main()
