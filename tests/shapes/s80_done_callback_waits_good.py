"""A done-callback on one thread waits for an event that a subscription sets. Mended."""

import threading

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger


class Reporter(Node):
    def __init__(self):
        super().__init__('reporter')
        self.received = threading.Event()
        group = ReentrantCallbackGroup()
        self.client = self.create_client(Trigger, 'report', callback_group=group)
        self.create_service(Trigger, 'report', self.on_report, callback_group=group)
        self.create_subscription(String, 'ack', self.on_ack, 10, callback_group=group)
        self.acks = self.create_publisher(String, 'ack', 10)
        self.create_timer(0.5, self.report)

    def report(self):
        self.received.clear()
        self.client.call_async(Trigger.Request()).add_done_callback(self.on_reported)

    def on_report(self, request, response):
        return response

    def on_reported(self, future):
        self.acks.publish(String())

    def on_ack(self, msg):
        self.received.set()
        print('goes on')


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=3)
    executor.add_node(Reporter())
    executor.spin()


if __name__ == '__main__':
    main()
