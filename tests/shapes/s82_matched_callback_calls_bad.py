"""A callback for a new subscriber waits for an answer in the publisher's group."""

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.event_handler import PublisherEventCallbacks
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger


class Announcer(Node):
    def __init__(self):
        super().__init__('announcer')
        other = ReentrantCallbackGroup()
        self.client = self.create_client(Trigger, 'greet')
        self.create_service(Trigger, 'greet', self.on_greet, callback_group=other)
        events = PublisherEventCallbacks(matched=self.on_matched)
        self.publisher = self.create_publisher(String, 'news', 10, event_callbacks=events)
        self.create_timer(0.5, self.announce, callback_group=other)

    def on_matched(self, event):
        self.client.call(Trigger.Request())  # waits here
        print('goes on')

    def on_greet(self, request, response):
        return response

    def announce(self):
        self.publisher.publish(String())


class Listener(Node):
    def __init__(self):
        super().__init__('listener')
        self.subscription = None
        self.create_timer(0.6, self.toggle)

    def toggle(self):
        if self.subscription is None:
            self.subscription = self.create_subscription(String, 'news', self.on_news, 10)
        else:
            self.destroy_subscription(self.subscription)
            self.subscription = None

    def on_news(self, msg):
        pass


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(Announcer())
    executor.add_node(Listener())
    executor.spin()


if __name__ == '__main__':
    main()
