"""A cancel callback waits until execute has seen the request that it would accept."""

import threading
import time

import rclpy
from rclpy.action import ActionClient, ActionServer, CancelResponse
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from test_msgs.action import Fibonacci


class Oven(Node):
    def __init__(self):
        super().__init__('oven')
        self.over = threading.Event()
        self.server = ActionServer(
            self, Fibonacci, 'bake', self.bake, cancel_callback=self.on_cancel
        )

    def on_cancel(self, goal_handle):
        self.over.wait()  # waits here
        print('goes on')
        return CancelResponse.ACCEPT

    def bake(self, goal_handle):
        self.over.clear()
        while not goal_handle.is_cancel_requested:  # waits here
            time.sleep(0.05)
        goal_handle.canceled()
        self.over.set()
        return Fibonacci.Result()


class Baker(Node):
    def __init__(self):
        super().__init__('baker')
        self.action = ActionClient(self, Fibonacci, 'bake')
        self.create_timer(1.0, self.order)

    def order(self):
        self.action.send_goal_async(Fibonacci.Goal()).add_done_callback(self.on_accepted)

    def on_accepted(self, future):
        future.result().cancel_goal_async()


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(Oven())
    executor.add_node(Baker())
    executor.spin()


if __name__ == '__main__':
    main()
