"""A callback takes tasks as they complete, which take from a queue its own group fills. Mended."""

import concurrent.futures
import queue
from concurrent.futures import ThreadPoolExecutor

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Sorter(Node):
    def __init__(self):
        super().__init__('sorter')
        self.pool = ThreadPoolExecutor(max_workers=2)
        self.parts = queue.Queue()
        self.create_timer(0.5, self.sort)
        self.create_timer(0.4, self.on_part, callback_group=MutuallyExclusiveCallbackGroup())

    def sort(self):
        tasks = [self.pool.submit(self.parts.get) for _ in range(2)]
        for task in concurrent.futures.as_completed(tasks):
            task.result()
        print('goes on')

    def on_part(self):
        self.parts.put('part')


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Sorter())
    executor.spin()


if __name__ == '__main__':
    main()
