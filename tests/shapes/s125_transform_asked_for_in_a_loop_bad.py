"""A callback on one thread loops until a transform is there that its thread would take."""

import time

import rclpy
from rclpy.node import Node
from rclpy.time import Time
from tf2_ros import Buffer, TransformListener


class Follower(Node):
    def __init__(self):
        super().__init__('follower')
        self.buffer = Buffer()
        self.listener = TransformListener(self.buffer, self)
        self.create_timer(0.5, self.follow)

    def follow(self):
        while not self.buffer.can_transform('map', 'base', Time()):  # waits here
            time.sleep(0.1)
        print('goes on')


def main():
    rclpy.init()
    rclpy.spin(Follower())


if __name__ == '__main__':
    main()
