"""A goal callback waits for an answer in the group of its action server. Mended."""

import rclpy
from rclpy.action import ActionClient, ActionServer, GoalResponse
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger
from test_msgs.action import Fibonacci


class Kitchen(Node):
    def __init__(self):
        super().__init__('kitchen')
        self.client = self.create_client(
            Trigger, 'stock', callback_group=MutuallyExclusiveCallbackGroup()
        )
        self.server = ActionServer(self, Fibonacci, 'cook', self.cook, goal_callback=self.on_goal)

    def on_goal(self, request):
        self.client.call(Trigger.Request())
        print('goes on')
        return GoalResponse.ACCEPT

    def cook(self, goal_handle):
        goal_handle.succeed()
        return Fibonacci.Result()


class Guest(Node):
    def __init__(self):
        super().__init__('guest')
        self.create_service(Trigger, 'stock', self.on_stock)
        self.action = ActionClient(self, Fibonacci, 'cook')
        self.create_timer(0.5, self.order)

    def on_stock(self, request, response):
        return response

    def order(self):
        self.action.send_goal_async(Fibonacci.Goal())


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(Kitchen())
    executor.add_node(Guest())
    executor.spin()


if __name__ == '__main__':
    main()
