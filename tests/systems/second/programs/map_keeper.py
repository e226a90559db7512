"""Clears the map if the mission confirms it."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class MapKeeper(Node):
    def __init__(self):
        super().__init__('map_keeper')
        self.confirm = self.create_client(
            Trigger, 'confirm', callback_group=MutuallyExclusiveCallbackGroup()
        )
        self.create_service(Trigger, 'clear', self.on_clear)

    def on_clear(self, request, response):
        response.success = self.confirm.call(Trigger.Request()).success
        return response


def main():
    rclpy.init()
    node = MapKeeper()
    node.confirm.wait_for_service()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(node)
    executor.spin()


if __name__ == '__main__':
    main()
