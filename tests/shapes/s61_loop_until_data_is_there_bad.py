"""A service on one thread sleeps until a subscription has brought data."""

import time
from collections import deque

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger


class Weigher(Node):
    def __init__(self):
        super().__init__('weigher')
        self.weights = deque()
        others = MutuallyExclusiveCallbackGroup()
        self.create_service(Trigger, 'weigh', self.on_weigh)
        self.create_subscription(String, 'weight', self.on_weight, 10, callback_group=others)
        self.client = self.create_client(Trigger, 'weigh', callback_group=others)
        self.publisher = self.create_publisher(String, 'weight', 10)
        self.create_timer(0.4, self.ask, callback_group=others)
        self.create_timer(0.9, self.measure, callback_group=MutuallyExclusiveCallbackGroup())

    def ask(self):
        self.client.call_async(Trigger.Request())

    def measure(self):
        self.publisher.publish(String())

    def on_weight(self, msg):
        self.weights.append(msg.data)

    def on_weigh(self, request, response):
        while len(self.weights) == 0:  # waits here
            time.sleep(0.01)
        response.message = self.weights.popleft()
        print('goes on')
        return response


def main():
    rclpy.init()
    rclpy.spin(Weigher())


if __name__ == '__main__':
    main()
