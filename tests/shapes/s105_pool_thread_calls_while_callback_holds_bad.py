"""A task waits for an answer whose server takes a lock held while the task is awaited."""

import threading
from concurrent.futures import ThreadPoolExecutor

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Ledger(Node):
    def __init__(self):
        super().__init__('ledger')
        self.lock = threading.Lock()
        self.pool = ThreadPoolExecutor(max_workers=1)
        group = ReentrantCallbackGroup()
        self.client = self.create_client(Trigger, 'book', callback_group=group)
        self.create_service(Trigger, 'book', self.on_book, callback_group=group)
        self.create_timer(0.5, self.post)

    def post(self):
        with self.lock:
            self.pool.submit(self.book).result()  # waits here
        print('goes on')

    def book(self):
        self.client.call(Trigger.Request())  # waits here

    def on_book(self, request, response):
        with self.lock:  # waits here
            response.success = True
        return response


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(Ledger())
    executor.spin()


if __name__ == '__main__':
    main()
