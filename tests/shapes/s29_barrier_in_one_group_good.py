"""Two callbacks of one group meet at a barrier. Mended."""

import threading

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Pair(Node):
    def __init__(self):
        super().__init__('pair')
        self.meeting = threading.Barrier(2)
        self.create_timer(0.4, self.left)
        self.create_timer(0.4, self.right, callback_group=MutuallyExclusiveCallbackGroup())

    def left(self):
        self.meeting.wait()
        print('goes on')

    def right(self):
        self.meeting.wait()


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Pair())
    executor.spin()


if __name__ == '__main__':
    main()
