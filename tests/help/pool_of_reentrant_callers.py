"""A timer calls a slow service in a reentrant group, until its runs have taken all threads."""

import time

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Asker(Node):
    def __init__(self):
        super().__init__('asker')
        group = ReentrantCallbackGroup()
        self.client = self.create_client(Trigger, 'answer', callback_group=group)
        self.create_service(Trigger, 'answer', self.on_request)
        self.create_timer(0.2, self.ask, callback_group=group)

    def ask(self):
        self.client.call(Trigger.Request())
        print('goes on')

    def on_request(self, request, response):
        time.sleep(0.5)
        return response


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Asker())
    executor.spin()


if __name__ == '__main__':
    main()
