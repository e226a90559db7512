"""Asks the planner from ``plan``, which is called as what it asks for, and waits by an event."""

import threading

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Dispatcher(Node):
    def __init__(self):
        super().__init__('dispatcher')
        self.planner = self.create_client(
            Trigger, 'plan', callback_group=MutuallyExclusiveCallbackGroup()
        )
        beside = None
        if self.declare_parameter('beside', False).value:
            beside = MutuallyExclusiveCallbackGroup()
        self.create_service(Trigger, 'back', self.on_back, callback_group=beside)
        self.create_timer(0.2, self.plan)

    def plan(self):
        print('asks', flush=True)
        answered = threading.Event()
        future = self.planner.call_async(Trigger.Request())
        future.add_done_callback(lambda _: answered.set())
        answered.wait()
        print('goes on', flush=True)

    def on_back(self, request, response):
        return response


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=4)
    node = Dispatcher()
    node.planner.wait_for_service()
    executor.add_node(node)
    executor.spin()


if __name__ == '__main__':
    main()
