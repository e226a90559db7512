"""A callback spins for an answer while it holds a lock, and whom it serves takes the lock."""

import threading

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Planner(Node):
    def __init__(self):
        super().__init__('planner')
        self.lock = threading.Lock()
        self.goals = 0
        others = ReentrantCallbackGroup()
        self.client = self.create_client(Trigger, 'plan', callback_group=others)
        self.create_timer(0.3, self.replan)
        self.create_timer(0.02, self.on_goal, callback_group=others)

    def replan(self):
        with self.lock:
            future = self.client.call_async(Trigger.Request())
            self.executor.spin_until_future_complete(future, timeout_sec=0.2)
        print('goes on')

    def on_goal(self):
        with self.lock:
            self.goals += 1


def main():
    rclpy.init()
    executor = SingleThreadedExecutor()
    executor.add_node(Planner())
    executor.spin()


if __name__ == '__main__':
    main()
