"""A13: the callback looks once and leaves the rest to the next message."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Gate(Node):
    def __init__(self):
        super().__init__('gate')
        self.position = None
        self.create_subscription(String, 'position', self.on_position, 10)
        self.create_subscription(String, 'open', self.on_open, 10)

    def on_position(self, msg):
        self.position = msg.data

    def on_open(self, msg):
        if self.position != 'top':
            self.get_logger().info('not yet')


def main():
    rclpy.init()
    rclpy.spin(Gate())


if __name__ == '__main__':
    main()

# finds: nothing
