"""A callback waits for several tasks, one of which waits for the callback's group."""

import concurrent.futures
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Cameras(Node):
    def __init__(self):
        super().__init__('cameras')
        self.pool = ThreadPoolExecutor(max_workers=2)
        self.exposed = threading.Event()
        self.create_timer(0.5, self.shoot)
        self.create_timer(0.3, self.on_exposed)

    def shoot(self):
        self.exposed.clear()
        tasks = [self.pool.submit(self.expose), self.pool.submit(time.sleep, 0.01)]
        concurrent.futures.wait(tasks)  # waits here
        print('goes on')

    def expose(self):
        self.exposed.wait()  # waits here

    def on_exposed(self):
        self.exposed.set()


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Cameras())
    executor.spin()


if __name__ == '__main__':
    main()
