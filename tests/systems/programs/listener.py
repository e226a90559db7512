"""Hears what is said, as another type than it is said in."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32


class Listener(Node):
    def __init__(self):
        super().__init__('listener')
        self.create_subscription(Int32, 'said', self.on_said, 10)

    def on_said(self, message):
        print(message.data)


def main():
    rclpy.init()
    rclpy.spin(Listener())


if __name__ == '__main__':
    main()
