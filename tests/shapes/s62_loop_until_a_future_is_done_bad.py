"""A callback sleeps until the future of its request is done, in its own group."""

import time

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Finder(Node):
    def __init__(self):
        super().__init__('finder')
        self.create_service(
            Trigger, 'find', self.on_find, callback_group=MutuallyExclusiveCallbackGroup()
        )
        self.client = self.create_client(Trigger, 'find')
        self.create_timer(0.5, self.find)

    def find(self):
        future = self.client.call_async(Trigger.Request())
        while not future.done():  # waits here
            time.sleep(0.01)
        print('goes on')

    def on_find(self, request, response):
        return response


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=3)
    executor.add_node(Finder())
    executor.spin()


if __name__ == '__main__':
    main()
