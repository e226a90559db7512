"""Asks by a topic and waits for the reply on another one; its details are a service."""

import threading

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger


class Requester(Node):
    def __init__(self):
        super().__init__('requester')
        self.replied = threading.Event()
        apart = self.declare_parameter('apart', False).value
        details = MutuallyExclusiveCallbackGroup() if apart else None
        self.orders = self.create_publisher(String, 'orders', 10)
        self.create_subscription(
            String, 'replies', self.on_reply, 10, callback_group=MutuallyExclusiveCallbackGroup()
        )
        self.create_service(Trigger, 'details', self.on_details, callback_group=details)
        self.create_timer(0.2, self.order)

    def order(self):
        if self.orders.get_subscription_count() == 0:
            return
        print('asks', flush=True)
        self.replied.clear()
        self.orders.publish(String(data='one'))
        self.replied.wait()
        print('goes on', flush=True)

    def on_reply(self, message):
        self.replied.set()

    def on_details(self, request, response):
        response.message = 'two sugars'
        return response


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(Requester())
    executor.spin()


if __name__ == '__main__':
    main()
