"""Sends a goal from a timer and waits for its result; ``confirm`` is asked for by the map."""

import rclpy
from rclpy.action import ActionClient
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger
from test_msgs.action import Fibonacci


class Mission(Node):
    def __init__(self):
        super().__init__('mission')
        self.declare_parameter('beside', False)
        goals = MutuallyExclusiveCallbackGroup()
        steps = MutuallyExclusiveCallbackGroup()
        confirms = steps
        if self.get_parameter('beside').value:
            confirms = MutuallyExclusiveCallbackGroup()
        self.drive = ActionClient(self, Fibonacci, 'drive', callback_group=goals)
        self.create_service(Trigger, 'confirm', self.on_confirm, callback_group=confirms)
        self.create_timer(0.3, self.step, callback_group=steps)

    def step(self):
        print('asks', flush=True)
        goal = Fibonacci.Goal()
        goal.order = 3
        self.drive.send_goal(goal)
        print('goes on', flush=True)

    def on_confirm(self, request, response):
        response.success = True
        return response


def main():
    rclpy.init()
    node = Mission()
    node.drive.wait_for_server()
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(node)
    executor.spin()


if __name__ == '__main__':
    main()
