"""Shows images, as they come."""

import rclpy
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from std_msgs.msg import String


class Viewer(Node):
    def __init__(self):
        super().__init__('viewer')
        self.create_subscription(String, 'image', self.on_image, qos_profile_sensor_data)

    def on_image(self, message):
        print(message.data)


def main():
    rclpy.init()
    rclpy.spin(Viewer())


if __name__ == '__main__':
    main()
