"""Asks whether a part is there, and then clears the event that says so: a signal may be lost."""

import threading

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger


class Feeder(Node):
    def __init__(self):
        super().__init__('feeder')
        self.parts = 0
        self.arrived = threading.Event()
        self.create_subscription(
            String, 'first', self.on_first, 1, callback_group=MutuallyExclusiveCallbackGroup()
        )
        self.create_service(
            Trigger, 'take', self.on_take, callback_group=MutuallyExclusiveCallbackGroup()
        )

    def on_first(self, msg):
        if self.parts == 0:
            self.parts = 1
            self.arrived.set()

    def on_take(self, request, response):
        if self.parts == 0:
            self.arrived.clear()
            self.arrived.wait()
        response.success = True
        return response


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=3)
    executor.add_node(Feeder())
    executor.spin()


if __name__ == '__main__':
    main()
