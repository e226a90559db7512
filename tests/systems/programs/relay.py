"""Answers ``request`` once ``next`` has answered; whom that is, the launch file says."""

import rclpy
from example_interfaces.srv import AddTwoInts
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Relay(Node):
    def __init__(self):
        super().__init__('relay')
        answers = MutuallyExclusiveCallbackGroup()
        self.next = self.create_client(AddTwoInts, 'next', callback_group=answers)
        self.create_service(AddTwoInts, 'request', self.on_request)
        if self.declare_parameter('begins', False).value:
            self.create_timer(0.2, self.tick)

    def tick(self):
        self.next.call(AddTwoInts.Request())
        print('goes on', flush=True)

    def on_request(self, request, response):
        self.next.call(AddTwoInts.Request())
        return response


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Relay())
    executor.spin()


if __name__ == '__main__':
    main()
