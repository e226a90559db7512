"""A service on one thread takes from a queue that a timer fills. Mended."""

import queue

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Reader(Node):
    def __init__(self):
        super().__init__('reader')
        self.scans = queue.SimpleQueue()
        clients = MutuallyExclusiveCallbackGroup()
        self.create_service(Trigger, 'scan', self.on_scan)
        self.client = self.create_client(Trigger, 'scan', callback_group=clients)
        self.create_timer(0.5, self.ask, callback_group=clients)
        self.create_timer(0.6, self.measure, callback_group=MutuallyExclusiveCallbackGroup())

    def ask(self):
        self.client.call_async(Trigger.Request())

    def measure(self):
        self.scans.put('scan')

    def on_scan(self, request, response):
        response.message = self.scans.get()
        print('goes on')
        return response


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=3)
    executor.add_node(Reader())
    executor.spin()


if __name__ == '__main__':
    main()
