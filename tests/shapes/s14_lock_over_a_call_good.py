"""A callback holds a lock while it waits for an answer, and the server takes the lock. Mended."""

import threading

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Base(Node):
    def __init__(self):
        super().__init__('base')
        self.lock = threading.Lock()
        self.mode = 0
        clients = MutuallyExclusiveCallbackGroup()
        self.client = self.create_client(Trigger, 'mode', callback_group=clients)
        services = MutuallyExclusiveCallbackGroup()
        self.create_service(Trigger, 'mode', self.on_mode, callback_group=services)
        self.create_timer(0.5, self.switch)

    def switch(self):
        self.client.call(Trigger.Request())
        with self.lock:
            print('goes on')

    def on_mode(self, request, response):
        with self.lock:
            self.mode += 1
        return response


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(Base())
    executor.spin()


if __name__ == '__main__':
    main()
