"""Holds a lock while it calls a service of its own, which sometimes needs the lock."""

import threading

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger


class Map(Node):
    def __init__(self):
        super().__init__('map')
        self.lock = threading.Lock()
        self.stale = False
        self.client = self.create_client(
            Trigger, 'tile', callback_group=MutuallyExclusiveCallbackGroup()
        )
        self.create_service(
            Trigger, 'tile', self.on_tile, callback_group=MutuallyExclusiveCallbackGroup()
        )
        self.create_subscription(
            String, 'moved', self.on_moved, 1, callback_group=MutuallyExclusiveCallbackGroup()
        )
        self.create_timer(0.23, self.redraw, callback_group=MutuallyExclusiveCallbackGroup())

    def on_moved(self, msg):
        self.stale = True
        self.get_logger().debug('moved')
        self.stale = False

    def redraw(self):
        with self.lock:
            self.client.call(Trigger.Request())

    def on_tile(self, request, response):
        if self.stale:
            with self.lock:
                response.message = 'new'
        return response


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(Map())
    executor.spin()


if __name__ == '__main__':
    main()
