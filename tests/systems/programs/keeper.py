"""Holds its lock while it asks for a confirmation; ``read`` needs the lock too."""

import threading

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Keeper(Node):
    def __init__(self):
        super().__init__('keeper')
        self.lock = threading.Lock()
        self.count = 0
        self.confirm = self.create_client(
            Trigger, 'confirm', callback_group=MutuallyExclusiveCallbackGroup()
        )
        self.create_service(
            Trigger, 'read', self.on_read, callback_group=MutuallyExclusiveCallbackGroup()
        )
        self.create_timer(0.2, self.tick)

    def tick(self):
        print('asks', flush=True)
        with self.lock:
            self.count += 1
            self.confirm.call(Trigger.Request())
        print('goes on', flush=True)

    def on_read(self, request, response):
        with self.lock:
            response.message = str(self.count)
        return response


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=4)
    node = Keeper()
    node.confirm.wait_for_service()
    executor.add_node(node)
    executor.spin()


if __name__ == '__main__':
    main()
