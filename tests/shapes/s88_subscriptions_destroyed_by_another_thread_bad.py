"""A thread makes and destroys subscriptions while a pool serves them."""

import threading
import time

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String


class Switch(Node):
    def __init__(self):
        super().__init__('switch')
        self.publisher = self.create_publisher(String, 'view', 10)
        self.create_timer(0.002, self.send, callback_group=ReentrantCallbackGroup())
        self.create_timer(0.5, self.beat, callback_group=ReentrantCallbackGroup())
        threading.Thread(target=self.look, daemon=True).start()

    def send(self):
        self.publisher.publish(String())

    def beat(self):
        print('goes on')

    def look(self):
        while rclpy.ok():
            group = MutuallyExclusiveCallbackGroup()
            view = self.create_subscription(String, 'view', self.on_view, 1, callback_group=group)
            time.sleep(0.02)
            self.destroy_subscription(view)  # breaks here

    def on_view(self, msg):
        pass


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=3)
    executor.add_node(Switch())
    executor.spin()


if __name__ == '__main__':
    main()
