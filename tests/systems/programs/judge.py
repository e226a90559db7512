"""Asks for a permit before it accepts a goal."""

import rclpy
from rclpy.action import ActionServer, GoalResponse
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger
from test_msgs.action import Fibonacci


class Judge(Node):
    def __init__(self):
        super().__init__('mover')
        answers = MutuallyExclusiveCallbackGroup()
        self.permit = self.create_client(Trigger, 'permit', callback_group=answers)
        self.server = ActionServer(
            self, Fibonacci, 'move', self.execute, goal_callback=self.on_goal
        )

    def on_goal(self, goal):
        print('asks back', flush=True)
        self.permit.call(Trigger.Request())
        return GoalResponse.ACCEPT

    def execute(self, goal):
        goal.succeed()
        return Fibonacci.Result()


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=3)
    node = Judge()
    node.permit.wait_for_service()
    executor.add_node(node)
    executor.spin()


if __name__ == '__main__':
    main()
