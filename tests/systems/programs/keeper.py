"""Holds its lock while it asks for a confirmation; ``read`` needs the lock too."""

import threading

import rclpy
from example_interfaces.srv import AddTwoInts
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Keeper(Node):
    def __init__(self):
        super().__init__('keeper')
        self.lock = threading.Lock()
        self.count = 0
        self.confirm = self.create_client(
            AddTwoInts, 'confirm', callback_group=MutuallyExclusiveCallbackGroup()
        )
        self.create_service(
            AddTwoInts, 'read', self.on_read, callback_group=MutuallyExclusiveCallbackGroup()
        )
        self.create_timer(0.2, self.tick)

    def tick(self):
        with self.lock:
            self.count += 1
            self.confirm.call(AddTwoInts.Request())
        print('goes on', flush=True)

    def on_read(self, request, response):
        with self.lock:
            response.sum = self.count
        return response


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(Keeper())
    executor.spin()


if __name__ == '__main__':
    main()
