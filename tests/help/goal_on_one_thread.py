"""A goal cannot be cancelled, since its execute callback holds the only thread."""

import time

import rclpy
from rclpy.action import ActionClient, ActionServer, CancelResponse
from rclpy.node import Node
from test_msgs.action import Fibonacci


class Mover(Node):
    def __init__(self):
        super().__init__('mover')
        self.server = ActionServer(
            self, Fibonacci, 'move', self.execute, cancel_callback=self.on_cancel
        )
        self.client = ActionClient(self, Fibonacci, 'move')
        self.client.send_goal_async(Fibonacci.Goal()).add_done_callback(self.on_accepted)

    def on_accepted(self, future):
        future.result().cancel_goal_async()

    def on_cancel(self, goal_handle):
        return CancelResponse.ACCEPT

    def execute(self, goal_handle):
        for _ in range(100):
            if goal_handle.is_cancel_requested:
                print('goes on')
                goal_handle.canceled()
                return Fibonacci.Result()
            time.sleep(0.1)
        goal_handle.succeed()
        return Fibonacci.Result()


def main():
    rclpy.init()
    rclpy.spin(Mover())


if __name__ == '__main__':
    main()
