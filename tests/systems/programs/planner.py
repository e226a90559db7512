"""Serves ``plan``, and asks back before it answers."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Planner(Node):
    def __init__(self):
        super().__init__('planner')
        answers = MutuallyExclusiveCallbackGroup()
        self.back = self.create_client(Trigger, 'back', callback_group=answers)
        self.create_service(Trigger, 'plan', self.on_plan)

    def on_plan(self, request, response):
        print('asks back', flush=True)
        self.back.call(Trigger.Request())
        return response


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    node = Planner()
    node.back.wait_for_service()
    executor.add_node(node)
    executor.spin()


if __name__ == '__main__':
    main()
