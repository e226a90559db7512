"""A callback raises in the thread that spins, and main waits for what it would set."""

import queue
import threading

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node


class Parser(Node):
    def __init__(self):
        super().__init__('parser')
        self.lines = queue.Queue()
        self.count = 0
        self.create_timer(0.2, self.parse)

    def parse(self):
        self.count += 1
        if self.count == 5:
            raise ValueError('bad line')  # breaks here
        self.lines.put(self.count)


def main():
    rclpy.init()
    node = Parser()
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    threading.Thread(target=executor.spin, daemon=True).start()
    while rclpy.ok():
        node.lines.get()  # waits here
        print('goes on')


if __name__ == '__main__':
    main()
