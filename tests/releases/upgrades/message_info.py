"""A subscription that asks for the information of a message, too."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Delay(Node):
    def __init__(self):
        super().__init__('delay')
        self.publisher = self.create_publisher(String, 'words', 10)
        self.create_subscription(String, 'words', self.on_word, 10)
        self.create_timer(0.3, self.say)

    def say(self):
        self.publisher.publish(String(data='hello'))

    # differs: message-info
    def on_word(self, message, info):
        print(message.data, info is not None, flush=True)


def main():
    rclpy.init()
    rclpy.spin(Delay())


if __name__ == '__main__':
    main()
