"""A callback joins a thread that waits for an event of the callback's own group."""

import threading

import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Door(Node):
    def __init__(self):
        super().__init__('door')
        self.opened = threading.Event()
        self.create_timer(0.5, self.enter)
        self.create_timer(0.8, self.on_opened)

    def enter(self):
        guard = threading.Thread(target=self.wait_at_door, daemon=True)
        guard.start()
        guard.join()  # waits here
        print('goes on')

    def wait_at_door(self):
        self.opened.wait()  # waits here
        self.opened.clear()

    def on_opened(self):
        self.opened.set()


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Door())
    executor.spin()


if __name__ == '__main__':
    main()
