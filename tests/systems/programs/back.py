"""Serves `back`, and asks the front office for the address before it answers."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Back(Node):
    def __init__(self):
        super().__init__('back')
        answers = MutuallyExclusiveCallbackGroup()
        self.address = self.create_client(Trigger, 'address', callback_group=answers)
        self.create_service(Trigger, 'back', self.on_back)

    def on_back(self, request, response):
        self.address.call(Trigger.Request())
        return response


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=3)
    node = Back()
    node.address.wait_for_service()
    executor.add_node(node)
    executor.spin()


if __name__ == '__main__':
    main()
