"""A callback waits for an event that a callback of its own group sets."""

import threading

import rclpy
from rclpy import executors
from rclpy.node import Node


class Waiter(Node):
    def __init__(self):
        super().__init__('waiter')
        self.event = threading.Event()
        self.timer = self.create_timer(0.1, self.ask)
        self.create_timer(0.3, self.signal)

    def ask(self):
        self.timer.cancel()
        print('asks', flush=True)
        self.event.wait()
        print('goes on', flush=True)

    def signal(self):
        self.event.set()


def main():
    rclpy.init()
    node = Waiter()
    executor = executors.MultiThreadedExecutor(num_threads=4)
    executor.add_node(node)
    executor.spin()


if __name__ == '__main__':
    main()

# single: blocks
# multi: blocks
