"""A callback for a missed deadline waits for the message of its own subscription. Mended."""

import threading

import rclpy
from rclpy.duration import Duration
from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from rclpy.qos import QoSProfile
from std_msgs.msg import String


class Heartbeat(Node):
    def __init__(self):
        super().__init__('heartbeat')
        self.alive = threading.Event()
        events = SubscriptionEventCallbacks(deadline=self.on_missed)
        profile = QoSProfile(depth=1, deadline=Duration(seconds=0.3))
        self.create_subscription(String, 'beat', self.on_beat, profile, event_callbacks=events)

    def on_beat(self, msg):
        self.alive.set()

    def on_missed(self, event):
        self.alive.clear()
        print('goes on')


class Heart(Node):
    def __init__(self):
        super().__init__('heart')
        profile = QoSProfile(depth=1, deadline=Duration(seconds=0.3))
        self.publisher = self.create_publisher(String, 'beat', profile)
        self.create_timer(0.8, self.beat)

    def beat(self):
        self.publisher.publish(String())


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=3)
    executor.add_node(Heartbeat())
    executor.add_node(Heart())
    executor.spin()


if __name__ == '__main__':
    main()
