"""A callback works until a flag falls, and the timer that lowers it is in its group."""

import queue

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Scale(Node):
    def __init__(self):
        super().__init__('scale')
        self.running = True
        self.weights = queue.Queue()
        self.create_timer(0.5, self.weigh)
        self.create_timer(0.7, self.stop)
        group = MutuallyExclusiveCallbackGroup()
        self.create_timer(0.1, self.put, callback_group=group)

    def put(self):
        self.weights.put(7)

    def stop(self):
        self.running = False

    def weigh(self):
        self.running = True
        while self.running:  # waits here
            self.weights.get()
        print('goes on')


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=3)
    executor.add_node(Scale())
    executor.spin()


if __name__ == '__main__':
    main()
