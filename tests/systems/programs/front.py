"""Answers many at once, each with the help of the back office, which asks for the address."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Front(Node):
    def __init__(self):
        super().__init__('front')
        answers = MutuallyExclusiveCallbackGroup()
        self.back = self.create_client(Trigger, 'back', callback_group=answers)
        self.create_service(
            Trigger, 'front', self.on_front, callback_group=ReentrantCallbackGroup()
        )
        self.create_service(
            Trigger, 'address', self.on_address, callback_group=MutuallyExclusiveCallbackGroup()
        )

    def on_front(self, request, response):
        self.back.call(Trigger.Request())
        return response

    def on_address(self, request, response):
        return response


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=12)
    node = Front()
    node.back.wait_for_service()
    executor.add_node(node)
    executor.spin()


if __name__ == '__main__':
    main()
