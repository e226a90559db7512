"""G4: the callback spins for the answer first, and takes the lock afterwards."""

import threading

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger


class Planner(Node):
    def __init__(self):
        super().__init__('planner')
        self.lock = threading.Lock()
        others = ReentrantCallbackGroup()
        self.client = self.create_client(Trigger, 'plan', callback_group=others)
        self.create_timer(0.05, self.replan)
        self.create_subscription(String, 'goal', self.on_goal, 10, callback_group=others)

    def replan(self):
        future = self.client.call_async(Trigger.Request())
        future.add_done_callback(self.on_plan)

    def on_plan(self, future):
        with self.lock:
            self.plan = future.result()

    def on_goal(self, message):
        with self.lock:
            self.goal = message


def main():
    rclpy.init()
    executor = SingleThreadedExecutor()
    executor.add_node(Planner())
    executor.spin()


if __name__ == '__main__':
    main()

# finds: CC402:17 note
