"""Publishes its map, once at the start and then when it changes."""

import rclpy
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import String


class MapPublisher(Node):
    def __init__(self):
        super().__init__('map_publisher')
        latched = self.declare_parameter('latched', True).value
        quality = QoSProfile(depth=1)
        if latched:
            quality.durability = DurabilityPolicy.TRANSIENT_LOCAL
        self.maps = self.create_publisher(String, 'map', quality)
        self.create_timer(0.3, self.changed)

    def changed(self):
        self.maps.publish(String(data='map'))


def main():
    rclpy.init()
    rclpy.spin(MapPublisher())


if __name__ == '__main__':
    main()
