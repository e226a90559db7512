"""A sensor with a life cycle: publishes once it is active."""

import rclpy
from rclpy.lifecycle import LifecycleNode, TransitionCallbackReturn
from std_msgs.msg import String


class Lidar(LifecycleNode):
    def __init__(self):
        super().__init__('lidar')
        self.scans = None
        self.timer = None

    def on_configure(self, state):
        self.scans = self.create_lifecycle_publisher(String, 'scan', 10)
        self.timer = self.create_timer(0.2, self.scan)
        return TransitionCallbackReturn.SUCCESS

    def scan(self):
        self.scans.publish(String(data='scan'))


def main():
    rclpy.init()
    rclpy.spin(Lidar())


if __name__ == '__main__':
    main()
