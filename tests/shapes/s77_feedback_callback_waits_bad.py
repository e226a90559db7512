"""A feedback callback waits for the result, which the same client would bring."""

import threading
import time

import rclpy
from rclpy.action import ActionClient, ActionServer
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from test_msgs.action import Fibonacci


class Courier(Node):
    def __init__(self):
        super().__init__('courier')
        self.server = ActionServer(self, Fibonacci, 'carry', self.carry)

    def carry(self, goal_handle):
        for _ in range(3):
            goal_handle.publish_feedback(Fibonacci.Feedback())
            time.sleep(0.05)
        goal_handle.succeed()
        return Fibonacci.Result()


class Sender(Node):
    def __init__(self):
        super().__init__('sender')
        self.delivered = threading.Event()
        self.action = ActionClient(self, Fibonacci, 'carry')
        self.create_timer(1.0, self.send, callback_group=MutuallyExclusiveCallbackGroup())

    def send(self):
        self.delivered.clear()
        future = self.action.send_goal_async(Fibonacci.Goal(), feedback_callback=self.on_feedback)
        future.add_done_callback(self.on_accepted)

    def on_feedback(self, message):
        self.delivered.wait()  # waits here
        print('goes on')

    def on_accepted(self, future):
        future.result().get_result_async().add_done_callback(self.on_result)

    def on_result(self, future):
        self.delivered.set()


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(Courier())
    executor.add_node(Sender())
    executor.spin()


if __name__ == '__main__':
    main()
