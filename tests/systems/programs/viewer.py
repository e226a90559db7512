"""Shows images, and wants none of them lost."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Viewer(Node):
    def __init__(self):
        super().__init__('viewer')
        self.create_subscription(String, 'image', self.on_image, 10)

    def on_image(self, message):
        print(message.data)


def main():
    rclpy.init()
    rclpy.spin(Viewer())


if __name__ == '__main__':
    main()
