"""H1: a goal cannot be cancelled, since its execute callback holds the only thread."""

import time

import rclpy
from rclpy.action import ActionServer, CancelResponse
from rclpy.node import Node
from test_msgs.action import Fibonacci


class Mover(Node):
    def __init__(self):
        super().__init__('mover')
        self.server = ActionServer(
            self, Fibonacci, 'move', self.execute, cancel_callback=self.on_cancel
        )

    def on_cancel(self, goal_handle):
        return CancelResponse.ACCEPT

    def execute(self, goal_handle):
        for _ in range(10):
            if goal_handle.is_cancel_requested:
                goal_handle.canceled()
                return Fibonacci.Result()
            time.sleep(0.5)
        goal_handle.succeed()
        return Fibonacci.Result()


def main():
    rclpy.init()
    rclpy.spin(Mover())


if __name__ == '__main__':
    main()

# finds: CC203:26 warning
