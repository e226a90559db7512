"""As many goals as there are threads wait for an event that a timer sets."""

import threading

import rclpy
from rclpy.action import ActionClient, ActionServer
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from test_msgs.action import Fibonacci


class Depot(Node):
    def __init__(self):
        super().__init__('depot')
        self.open = threading.Event()
        self.server = ActionServer(self, Fibonacci, 'load', self.load)
        self.create_timer(1.5, self.unlock, callback_group=MutuallyExclusiveCallbackGroup())

    def unlock(self):
        self.open.set()

    def load(self, goal_handle):
        self.open.wait()  # waits here
        goal_handle.succeed()
        print('goes on')
        return Fibonacci.Result()


class Trucks(Node):
    def __init__(self):
        super().__init__('trucks')
        self.action = ActionClient(self, Fibonacci, 'load')
        self.create_timer(0.4, self.send)

    def send(self):
        self.action.send_goal_async(Fibonacci.Goal())


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Depot())
    executor.add_node(Trucks())
    executor.spin()


if __name__ == '__main__':
    main()
