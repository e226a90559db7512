"""Asks the planner from a timer; ``back`` is served in the timer's own group, or beside it."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        answers = MutuallyExclusiveCallbackGroup()
        self.plan = self.create_client(Trigger, 'plan', callback_group=answers)
        beside = None
        if self.declare_parameter('beside', False).value:
            beside = MutuallyExclusiveCallbackGroup()
        self.create_service(Trigger, 'back', self.on_back, callback_group=beside)
        self.create_timer(0.2, self.tick)

    def tick(self):
        print('asks', flush=True)
        self.plan.call(Trigger.Request())
        print('goes on', flush=True)

    def on_back(self, request, response):
        return response


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=3)
    node = Arm()
    node.plan.wait_for_service()
    executor.add_node(node)
    executor.spin()


if __name__ == '__main__':
    main()
