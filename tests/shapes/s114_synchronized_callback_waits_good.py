"""A synchronized callback waits for an event that a callback of its group sets. Mended."""

import threading

import rclpy
from message_filters import Subscriber, TimeSynchronizer
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String


class Fusion(Node):
    def __init__(self):
        super().__init__('fusion')
        self.ready = threading.Event()
        left = Subscriber(self, String, 'left')
        right = Subscriber(self, String, 'right')
        self.pairs = TimeSynchronizer([left, right], 10)
        self.pairs.registerCallback(self.on_pair)
        self.create_timer(0.5, self.get_ready, callback_group=MutuallyExclusiveCallbackGroup())

    def get_ready(self):
        self.ready.set()

    def on_pair(self, left, right):
        self.ready.clear()
        self.ready.wait()
        print('goes on')


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Fusion())
    executor.spin()


if __name__ == '__main__':
    main()
