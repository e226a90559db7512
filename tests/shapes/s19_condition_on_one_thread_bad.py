"""A callback on one thread waits on a condition that a timer notifies."""

import threading

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.node import Node
from std_msgs.msg import String


class Shutter(Node):
    def __init__(self):
        super().__init__('shutter')
        self.opened = threading.Condition()
        self.shots = self.create_publisher(String, 'shoot', 10)
        other = MutuallyExclusiveCallbackGroup()
        self.create_subscription(String, 'shoot', self.on_shoot, 10)
        self.create_timer(0.4, self.ask, callback_group=other)
        self.create_timer(0.1, self.on_opened, callback_group=other)

    def ask(self):
        self.shots.publish(String())

    def on_shoot(self, msg):
        with self.opened:
            self.opened.wait()  # waits here
        print('goes on')

    def on_opened(self):
        with self.opened:
            self.opened.notify_all()


def main():
    rclpy.init()
    rclpy.spin(Shutter())


if __name__ == '__main__':
    main()
