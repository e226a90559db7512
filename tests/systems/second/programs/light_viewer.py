"""Shows the map if it comes: best effort, and only what is new."""

import rclpy
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from std_msgs.msg import String


class LightViewer(Node):
    def __init__(self):
        super().__init__('light_viewer')
        self.create_subscription(String, 'map', self.on_map, qos_profile_sensor_data)
        print('asks', flush=True)

    def on_map(self, message):
        print('goes on', flush=True)


def main():
    rclpy.init()
    rclpy.spin(LightViewer())


if __name__ == '__main__':
    main()
