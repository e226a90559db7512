"""Tells where the robot is; asks somebody whom the launch file names."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Localizer(Node):
    def __init__(self):
        super().__init__('localizer')
        self.source = self.create_client(
            Trigger, 'position', callback_group=MutuallyExclusiveCallbackGroup()
        )
        self.create_service(Trigger, '~/pose', self.on_pose)

    def on_pose(self, request, response):
        found = self.source.call(Trigger.Request())
        response.message = found.message
        return response


def main():
    rclpy.init()
    node = Localizer()
    node.source.wait_for_service()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(node)
    executor.spin()


if __name__ == '__main__':
    main()
