"""Publishes images as sensors do: best effort."""

import rclpy
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from std_msgs.msg import String


class Camera(Node):
    def __init__(self):
        super().__init__('camera')
        rate = self.declare_parameter('frame_rate', 5.0).value
        quality = QoSProfile(depth=5, reliability=ReliabilityPolicy.BEST_EFFORT)
        self.images = self.create_publisher(String, 'image', quality)
        self.create_timer(1 / rate, self.tick)

    def tick(self):
        self.images.publish(String())


def main():
    rclpy.init()
    rclpy.spin(Camera())


if __name__ == '__main__':
    main()
