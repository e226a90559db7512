"""Drives: the map is cleared before each goal."""

import rclpy
from rclpy.action import ActionServer
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger
from test_msgs.action import Fibonacci


class Driver(Node):
    def __init__(self):
        super().__init__('driver')
        self.clear = self.create_client(
            Trigger, 'clear', callback_group=MutuallyExclusiveCallbackGroup()
        )
        self.server = ActionServer(
            self, Fibonacci, 'drive', self.execute, callback_group=ReentrantCallbackGroup()
        )

    def execute(self, goal_handle):
        self.clear.call(Trigger.Request())
        goal_handle.succeed()
        return Fibonacci.Result()


def main():
    rclpy.init()
    node = Driver()
    node.clear.wait_for_service()
    executor = MultiThreadedExecutor(num_threads=3)
    executor.add_node(node)
    executor.spin()


if __name__ == '__main__':
    main()
