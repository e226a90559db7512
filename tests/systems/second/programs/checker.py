"""Checks the level before it says yes."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Checker(Node):
    def __init__(self):
        super().__init__('checker')
        self.level = self.create_client(
            Trigger, 'level', callback_group=MutuallyExclusiveCallbackGroup()
        )
        self.create_service(Trigger, 'check', self.on_check)

    def on_check(self, request, response):
        response.success = self.level.call(Trigger.Request()).success
        return response


def main():
    rclpy.init()
    node = Checker()
    node.level.wait_for_service()
    executor = MultiThreadedExecutor()
    executor.add_node(node)
    executor.spin()


if __name__ == '__main__':
    main()
