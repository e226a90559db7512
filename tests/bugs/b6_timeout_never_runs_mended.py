"""B6: the timer has a group of its own."""

import threading

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Missions(Node):
    def __init__(self):
        super().__init__('missions')
        self.over = threading.Event()
        self.create_timer(1.0, self.on_timeout, callback_group=MutuallyExclusiveCallbackGroup())
        self.create_service(Trigger, 'upload', self.on_upload)

    def on_timeout(self):
        self.over.set()

    def on_upload(self, request, response):
        self.over.clear()
        self.over.wait()
        return response


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Missions())
    executor.spin()


if __name__ == '__main__':
    main()

# finds: nothing
