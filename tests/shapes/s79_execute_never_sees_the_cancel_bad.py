"""An execute callback on one thread waits for a cancel that the thread would take."""

import time

import rclpy
from rclpy.action import ActionClient, ActionServer, CancelResponse
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from test_msgs.action import Fibonacci


class Guard(Node):
    def __init__(self):
        super().__init__('guard')
        self.server = ActionServer(
            self, Fibonacci, 'watch', self.watch, cancel_callback=self.on_cancel
        )

    def on_cancel(self, goal_handle):
        return CancelResponse.ACCEPT

    def watch(self, goal_handle):
        while not goal_handle.is_cancel_requested:  # waits here
            time.sleep(0.05)
        goal_handle.canceled()
        print('goes on')
        return Fibonacci.Result()


class Chief(Node):
    def __init__(self):
        super().__init__('chief')
        self.action = ActionClient(self, Fibonacci, 'watch')
        self.create_timer(1.0, self.order)

    def order(self):
        self.action.send_goal_async(Fibonacci.Goal()).add_done_callback(self.on_accepted)

    def on_accepted(self, future):
        future.result().cancel_goal_async()


def main():
    rclpy.init()
    executor = SingleThreadedExecutor()
    executor.add_node(Guard())
    executor.add_node(Chief())
    executor.spin()


if __name__ == '__main__':
    main()
