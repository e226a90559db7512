"""A service asks another one that nobody offers, and answers 'no' if that takes too long."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Gate(Node):
    def __init__(self):
        super().__init__('gate')
        self.create_service(Trigger, 'open', self.on_open)
        others = MutuallyExclusiveCallbackGroup()
        self.guard = self.create_client(Trigger, 'nobody', callback_group=others)

    def on_open(self, request, response):
        # differs: call-takes-timeout, call-timeout-raises
        answer = self.guard.call(Trigger.Request(), 0.5)
        response.success = answer is not None
        print('answers', response.success, flush=True)
        return response


class Visitor(Node):
    def __init__(self):
        super().__init__('visitor')
        self.client = self.create_client(Trigger, 'open')
        self.create_timer(1.0, self.ring)

    def ring(self):
        if self.client.service_is_ready():
            self.client.call_async(Trigger.Request())


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=3)
    executor.add_node(Gate())
    executor.add_node(Visitor())
    executor.spin()


if __name__ == '__main__':
    main()
