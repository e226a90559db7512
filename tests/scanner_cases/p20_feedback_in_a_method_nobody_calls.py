"""P20: the feedback function stands in a method that no known code calls; so does the spin."""
# live: no, there is no program

import rclpy
from example_interfaces.action import Fibonacci
from rclpy.action import ActionClient
from rclpy.node import Node


class Navigator(Node):
    def __init__(self):
        super().__init__('navigator')
        self.walk = ActionClient(self, Fibonacci, 'walk')

    def go(self, goal):
        while not self.walk.wait_for_server(timeout_sec=1.0):
            pass
        future = self.walk.send_goal_async(goal, self.on_feedback)
        rclpy.spin_until_future_complete(self, future)

    def on_feedback(self, feedback):
        self.feedback = feedback


class Odd:
    def __init__(self):
        self.node = rclpy.create_node('odd')
        self.create_timer(1.0, print)


# expect:
# unit navigator: unknown executor
#   group navigator_default EXCLUSIVE default
#   action_client walk_action_client in navigator_default (Navigator.on_feedback) key=walk
#     writes Navigator.feedback @22
#   ? executor executor
#   ? navigator entities
# unit odd: no executor
#   ? executor executor
#   ? odd entities
