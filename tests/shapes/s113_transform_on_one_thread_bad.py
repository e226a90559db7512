"""A callback on one thread waits for a transform whose listener needs the thread."""

import rclpy
from rclpy.duration import Duration
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
        wait = Duration(seconds=1.0)
        self.buffer.lookup_transform('map', 'base', Time(), wait)  # waits here
        print('goes on')


def main():
    rclpy.init()
    rclpy.spin(Follower())


if __name__ == '__main__':
    main()
