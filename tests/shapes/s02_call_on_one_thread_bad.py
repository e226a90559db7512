"""A callback calls a service and waits, on the only thread of its executor."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger


class Asker(Node):
    def __init__(self):
        super().__init__('asker')
        group = MutuallyExclusiveCallbackGroup()
        self.client = self.create_client(Trigger, 'plan', callback_group=group)
        self.goals = self.create_publisher(String, 'goal', 10)
        self.create_timer(0.5, self.send, callback_group=group)
        self.create_subscription(String, 'goal', self.on_goal, 10)

    def send(self):
        self.goals.publish(String())

    def on_goal(self, msg):
        self.client.call(Trigger.Request())  # waits here
        print('goes on')


class Planner(Node):
    def __init__(self):
        super().__init__('planner')
        self.create_service(Trigger, 'plan', self.on_plan)

    def on_plan(self, request, response):
        return response


def main():
    rclpy.init()
    executor = SingleThreadedExecutor()
    executor.add_node(Asker())
    executor.add_node(Planner())
    executor.spin()


if __name__ == '__main__':
    main()
