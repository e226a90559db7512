"""A callback puts into a full queue that a callback of its own group would empty. Mended."""

import queue

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Logger(Node):
    def __init__(self):
        super().__init__('logger')
        self.lines = queue.Queue(maxsize=3)
        self.create_timer(0.1, self.log)
        self.create_timer(1.0, self.flush, callback_group=MutuallyExclusiveCallbackGroup())

    def log(self):
        self.lines.put('line')

    def flush(self):
        while not self.lines.empty():
            self.lines.get()
        print('goes on')


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Logger())
    executor.spin()


if __name__ == '__main__':
    main()
