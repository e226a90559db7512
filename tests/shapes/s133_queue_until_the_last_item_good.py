"""A callback takes from a queue until the last item comes."""

import queue

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Writer(Node):
    def __init__(self):
        super().__init__('writer')
        self.lines = queue.Queue()
        group = MutuallyExclusiveCallbackGroup()
        self.create_timer(0.1, self.put, callback_group=group)
        self.create_timer(0.5, self.write)

    def put(self):
        self.lines.put('line')
        self.lines.put(None)

    def write(self):
        while True:
            line = self.lines.get()
            if line is None:
                break
        print('goes on')


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Writer())
    executor.spin()


if __name__ == '__main__':
    main()
