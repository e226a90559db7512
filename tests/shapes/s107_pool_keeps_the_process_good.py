"""Main ends after the shutdown, but a pool's task takes from a queue forever. Mended."""

import queue
from concurrent.futures import ThreadPoolExecutor

import rclpy
from rclpy.node import Node


class Indexer(Node):
    def __init__(self):
        super().__init__('indexer')
        self.jobs = queue.Queue()
        ThreadPoolExecutor(max_workers=1).submit(self.index)
        self.create_timer(1.0, self.stop)

    def index(self):
        self.jobs.get()

    def stop(self):
        self.jobs.put(None)
        raise SystemExit


def main():
    rclpy.init()
    rclpy.spin(Indexer())


if __name__ == '__main__':
    main()
