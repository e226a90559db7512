"""G4: a callback spins for an answer while it holds a lock, and whom it serves takes the lock."""

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
        with self.lock:
            self.client.wait_for_service(timeout_sec=0.01)
            future = self.client.call_async(Trigger.Request())
            self.executor.spin_until_future_complete(future)

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

# finds: CC115:26, CC107:26 warning
