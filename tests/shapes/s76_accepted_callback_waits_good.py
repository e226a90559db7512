"""An accepted callback waits for the goal before, which a callback of its group ends. Mended."""

import threading

import rclpy
from rclpy.action import ActionClient, ActionServer
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from test_msgs.action import Fibonacci


class Crane(Node):
    def __init__(self):
        super().__init__('crane')
        self.free = threading.Event()
        self.server = ActionServer(
            self,
            Fibonacci,
            'lift',
            self.lift,
            handle_accepted_callback=self.on_accepted,
        )
        self.create_timer(0.3, self.on_free, callback_group=MutuallyExclusiveCallbackGroup())

    def on_free(self):
        self.free.set()

    def on_accepted(self, goal_handle):
        self.free.clear()
        self.free.wait()
        print('goes on')
        goal_handle.execute()

    def lift(self, goal_handle):
        goal_handle.succeed()
        return Fibonacci.Result()


class Yard(Node):
    def __init__(self):
        super().__init__('yard')
        self.action = ActionClient(self, Fibonacci, 'lift')
        self.create_timer(0.5, self.order)

    def order(self):
        self.action.send_goal_async(Fibonacci.Goal())


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(Crane())
    executor.add_node(Yard())
    executor.spin()


if __name__ == '__main__':
    main()
