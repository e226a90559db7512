"""Asks at once, whether anybody is there or not."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Hasty(Node):
    def __init__(self):
        super().__init__('hasty')
        answers = MutuallyExclusiveCallbackGroup()
        self.next = self.create_client(Trigger, 'next', callback_group=answers)
        self.create_service(Trigger, 'request', self.on_request)
        if self.declare_parameter('begins', False).value:
            self.create_timer(0.2, self.tick)

    def tick(self):
        print('asks', flush=True)
        self.next.call(Trigger.Request())
        print('goes on', flush=True)

    def on_request(self, request, response):
        print('asks back', flush=True)
        self.next.call(Trigger.Request())
        return response


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    node = Hasty()
    executor.add_node(node)
    executor.spin()


if __name__ == '__main__':
    main()
