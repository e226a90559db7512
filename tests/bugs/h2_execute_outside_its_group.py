"""H2: an exclusive group is not exclusive; execute runs as a task outside it."""

import threading

import rclpy
from rclpy.action import ActionServer
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from test_msgs.action import Fibonacci


class Mover(Node):
    def __init__(self):
        super().__init__('mover')
        self.lock = threading.Lock()
        self.position = 0
        group = MutuallyExclusiveCallbackGroup()
        self.server = ActionServer(self, Fibonacci, 'move', self.execute, callback_group=group)
        self.create_timer(0.1, self.drift, callback_group=group)

    def drift(self):
        self.position -= 1

    def execute(self, goal_handle):
        self.position = goal_handle.request.order
        goal_handle.succeed()
        return Fibonacci.Result()


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Mover())
    executor.spin()


if __name__ == '__main__':
    main()

# finds: CC303:23 note
