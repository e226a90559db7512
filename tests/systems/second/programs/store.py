"""Keeps records: to fetch one it asks the loader, which asks for the index of the store."""

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Store(Node):
    def __init__(self):
        super().__init__('store')
        group = ReentrantCallbackGroup()
        self.loader = self.create_client(Trigger, 'load', callback_group=group)
        self.create_service(Trigger, 'fetch', self.on_fetch, callback_group=group)
        self.create_service(Trigger, 'index', self.on_index, callback_group=group)

    def on_fetch(self, request, response):
        response.success = self.loader.call(Trigger.Request()).success
        return response

    def on_index(self, request, response):
        response.success = True
        return response


def main():
    rclpy.init()
    node = Store()
    node.declare_parameter('threads', 2)
    node.loader.wait_for_service()
    executor = MultiThreadedExecutor(num_threads=node.get_parameter('threads').value)
    executor.add_node(node)
    executor.spin()


if __name__ == '__main__':
    main()
