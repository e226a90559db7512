"""A callback leaves a with over a pool whose task waits for its group."""

import threading
from concurrent.futures import ThreadPoolExecutor

import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Welder(Node):
    def __init__(self):
        super().__init__('welder')
        self.cooled = threading.Event()
        self.create_timer(0.5, self.weld)
        self.create_timer(0.3, self.on_cooled)

    def weld(self):
        self.cooled.clear()
        with ThreadPoolExecutor(max_workers=1) as pool:  # waits here
            pool.submit(self.cool)
        print('goes on')

    def cool(self):
        self.cooled.wait()  # waits here

    def on_cooled(self):
        self.cooled.set()


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Welder())
    executor.spin()


if __name__ == '__main__':
    main()
