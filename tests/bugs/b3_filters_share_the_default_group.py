"""B3: a service waits for a pair of images, whose subscriptions share its default group."""

import threading

import message_filters
import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from sensor_msgs.msg import Image
from std_srvs.srv import Trigger


class Camera(Node):
    def __init__(self):
        super().__init__('camera')
        self.taken = threading.Event()
        color = message_filters.Subscriber(self, Image, 'color')
        depth = message_filters.Subscriber(self, Image, 'depth')
        self.pairs = message_filters.TimeSynchronizer([color, depth], 10)
        self.pairs.registerCallback(self.on_pair)
        self.create_service(Trigger, 'take', self.on_take)

    def on_pair(self, color, depth):
        self.taken.set()

    def on_take(self, request, response):
        self.taken.clear()
        self.taken.wait()
        return response


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(Camera())
    executor.spin()


if __name__ == '__main__':
    main()

# finds: CC101:28, CC401:34 warning
