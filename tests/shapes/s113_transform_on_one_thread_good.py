"""A callback on one thread waits for a transform whose listener needs the thread. Mended."""

import rclpy
from rclpy.duration import Duration
from rclpy.executors import MultiThreadedExecutor
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
        self.buffer.lookup_transform('map', 'base', Time(), wait)
        print('goes on')


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Follower())
    executor.spin()


if __name__ == '__main__':
    main()
