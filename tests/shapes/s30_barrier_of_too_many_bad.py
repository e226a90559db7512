"""Three callbacks meet at a barrier on two threads."""

import threading

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Stereo(Node):
    def __init__(self):
        super().__init__('stereo')
        self.meeting = threading.Barrier(3)
        self.create_timer(0.4, self.left, callback_group=MutuallyExclusiveCallbackGroup())
        self.create_timer(0.4, self.right, callback_group=MutuallyExclusiveCallbackGroup())
        self.create_timer(0.4, self.depth, callback_group=MutuallyExclusiveCallbackGroup())

    def left(self):
        self.meeting.wait()  # waits here

    def right(self):
        self.meeting.wait()  # waits here

    def depth(self):
        self.meeting.wait()  # waits here
        print('goes on')


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Stereo())
    executor.spin()


if __name__ == '__main__':
    main()
