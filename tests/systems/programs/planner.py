"""Serves ``plan``, and asks back before it answers."""

import rclpy
from example_interfaces.srv import AddTwoInts
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Planner(Node):
    def __init__(self):
        super().__init__('planner')
        answers = MutuallyExclusiveCallbackGroup()
        self.back = self.create_client(AddTwoInts, 'back', callback_group=answers)
        self.create_service(AddTwoInts, 'plan', self.on_plan)

    def on_plan(self, request, response):
        self.back.call(AddTwoInts.Request())
        return response


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Planner())
    executor.spin()


if __name__ == '__main__':
    main()
