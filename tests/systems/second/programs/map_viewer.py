"""Shows the map, also one that was published before it came."""

import rclpy
from rclpy.node import Node
from rclpy.qos import QoSDurabilityPolicy, QoSProfile, QoSReliabilityPolicy
from std_msgs.msg import String

LATCHED = QoSProfile(
    depth=1,
    durability=QoSDurabilityPolicy.TRANSIENT_LOCAL,
    reliability=QoSReliabilityPolicy.RELIABLE,
)


class MapViewer(Node):
    def __init__(self):
        super().__init__('map_viewer')
        self.create_subscription(String, 'map', self.on_map, LATCHED)
        print('asks', flush=True)

    def on_map(self, message):
        print('goes on', flush=True)


def main():
    rclpy.init()
    rclpy.spin(MapViewer())


if __name__ == '__main__':
    main()
