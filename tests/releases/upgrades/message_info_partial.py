"""One callback for two topics: the name is bound, the information is to come from rclpy."""

from functools import partial

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Relay(Node):
    def __init__(self):
        super().__init__('relay')
        self.publisher = self.create_publisher(String, 'left', 10)
        self.create_subscription(String, 'left', partial(self.on_any, 'left'), 10)
        self.create_timer(0.3, self.send)

    def send(self):
        self.publisher.publish(String(data='x'))

    # differs: message-info
    def on_any(self, side, message, info):
        print(side, message.data, flush=True)


def main():
    rclpy.init()
    rclpy.spin(Relay())


if __name__ == '__main__':
    main()
