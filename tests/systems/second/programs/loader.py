"""Loads what the index of the store says; any number of loads at a time."""

import time

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Loader(Node):
    def __init__(self):
        super().__init__('loader')
        group = ReentrantCallbackGroup()
        self.index = self.create_client(Trigger, 'index', callback_group=group)
        self.create_service(Trigger, 'load', self.on_load, callback_group=group)

    def on_load(self, request, response):
        time.sleep(0.3)
        self.index.call(Trigger.Request())
        response.success = True
        return response


def main():
    rclpy.init()
    node = Loader()
    node.index.wait_for_service()
    executor = MultiThreadedExecutor(num_threads=8)
    executor.add_node(node)
    executor.spin()


if __name__ == '__main__':
    main()
