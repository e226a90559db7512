"""Sends a goal from a timer, and another one before it gives the permit that the first needs."""

import rclpy
from rclpy.action import ActionClient
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger
from test_msgs.action import Fibonacci


class NestedBoss(Node):
    def __init__(self):
        super().__init__('boss')
        results = ReentrantCallbackGroup()
        self.move = ActionClient(self, Fibonacci, 'move', callback_group=results)
        beside = MutuallyExclusiveCallbackGroup()
        self.create_service(Trigger, 'permit', self.on_permit, callback_group=beside)
        self.create_timer(0.2, self.tick)

    def tick(self):
        self.move.send_goal(Fibonacci.Goal())

    def on_permit(self, request, response):
        self.move.send_goal(Fibonacci.Goal(order=1))
        return response


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=4)
    node = NestedBoss()
    node.move.wait_for_server()
    executor.add_node(node)
    executor.spin()


if __name__ == '__main__':
    main()
