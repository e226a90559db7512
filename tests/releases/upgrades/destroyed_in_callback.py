"""A callback renews a subscription again and again while other threads spin."""

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String


class Bridge(Node):
    def __init__(self):
        super().__init__('bridge')
        self.group = ReentrantCallbackGroup()
        self.publisher = self.create_publisher(String, 'words', 10)
        self.renew()
        self.create_timer(0.005, self.renew_all, callback_group=self.group)
        self.create_timer(0.002, self.say, callback_group=ReentrantCallbackGroup())

    def renew(self):
        self.words = self.create_subscription(
            String, 'words', self.on_word, 10, callback_group=self.group
        )

    def renew_all(self):
        self.destroy_subscription(self.words)
        self.renew()

    def say(self):
        self.publisher.publish(String(data='hello'))

    def on_word(self, message):
        self.heard = message.data


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(Bridge())
    executor.spin()


if __name__ == '__main__':
    main()
