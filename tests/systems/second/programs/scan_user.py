"""Uses scans."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class ScanUser(Node):
    def __init__(self):
        super().__init__('scan_user')
        self.create_subscription(String, 'scan', self.on_scan, 10)
        print('asks', flush=True)

    def on_scan(self, message):
        print('goes on', flush=True)


def main():
    rclpy.init()
    rclpy.spin(ScanUser())


if __name__ == '__main__':
    main()
