"""A callback waits for a task of a pool that calls a service over the callback's group."""

from concurrent.futures import ThreadPoolExecutor

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Detector(Node):
    def __init__(self):
        super().__init__('detector')
        self.pool = ThreadPoolExecutor(max_workers=2)
        other = MutuallyExclusiveCallbackGroup()
        self.client = self.create_client(Trigger, 'detect')
        self.create_service(Trigger, 'detect', self.on_detect, callback_group=other)
        self.create_timer(0.5, self.detect)

    def detect(self):
        self.pool.submit(self.ask).result()  # waits here
        print('goes on')

    def ask(self):
        return self.client.call(Trigger.Request())  # waits here

    def on_detect(self, request, response):
        return response


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=3)
    executor.add_node(Detector())
    executor.spin()


if __name__ == '__main__':
    main()
