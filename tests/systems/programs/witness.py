"""Confirms after it has read what is to be confirmed."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Witness(Node):
    def __init__(self):
        super().__init__('witness')
        self.read = self.create_client(
            Trigger, 'read', callback_group=MutuallyExclusiveCallbackGroup()
        )
        self.create_service(Trigger, 'confirm', self.on_confirm)

    def on_confirm(self, request, response):
        print('asks back', flush=True)
        self.read.call(Trigger.Request())
        return response


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    node = Witness()
    node.read.wait_for_service()
    executor.add_node(node)
    executor.spin()


if __name__ == '__main__':
    main()
