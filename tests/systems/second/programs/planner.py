"""Plans on the map: asks the mapper."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Planner(Node):
    def __init__(self):
        super().__init__('planner')
        answers = MutuallyExclusiveCallbackGroup()
        self.mapper = self.create_client(Trigger, '/mapper/map', callback_group=answers)
        self.create_service(Trigger, '~/plan', self.plan)

    def plan(self, request, response):
        self.mapper.wait_for_service()
        self.mapper.call(Trigger.Request())
        response.success = True
        return response


def main():
    rclpy.init()
    node = Planner()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(node)
    executor.spin()


if __name__ == '__main__':
    main()
