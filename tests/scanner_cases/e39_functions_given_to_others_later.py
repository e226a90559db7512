"""E39: a callback gives a function to an entity that was followed before; it is followed too."""

import threading

import rclpy
from test_msgs.action import Fibonacci
from rclpy.action import ActionClient
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.node import Node


class Sender(Node):
    def __init__(self):
        super().__init__('sender')
        self.delivered = threading.Event()
        self.action = ActionClient(self, Fibonacci, 'carry')
        self.create_timer(1.0, self.send, callback_group=MutuallyExclusiveCallbackGroup())

    def send(self):
        future = self.action.send_goal_async(Fibonacci.Goal(), feedback_callback=self.on_feedback)
        future.add_done_callback(self.on_accepted)

    def on_feedback(self, message):
        self.delivered.wait()

    def on_accepted(self, future):
        self.delivered.set()


def main():
    rclpy.init()
    rclpy.spin(Sender())


if __name__ == '__main__':
    main()


# expect:
# unit sender: SingleThreadedExecutor x1 rclpy.spin, main
#   group sender_default EXCLUSIVE default
#   group send_group EXCLUSIVE
#   group no_group REENTRANT groupless
#   timer send in send_group every 1
#     changes done_callback @21
#   action_client carry_action_client in sender_default (Sender.on_feedback) key=carry
#     blocks Event.wait on on_accepted through delivered @24
#       ended by on_accepted @27
#   done_callback on_accepted in no_group key=carry conditional when=callback
