"""F1: scans come faster than the rate lets them go, until every thread sleeps."""

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from sensor_msgs.msg import LaserScan
from std_msgs.msg import String


class Processor(Node):
    def __init__(self):
        super().__init__('processor')
        self.rate = self.create_rate(1.0)
        scans = ReentrantCallbackGroup()
        self.create_subscription(LaserScan, 'scan', self.on_scan, 10, callback_group=scans)
        self.create_subscription(String, 'command', self.on_command, 10)

    def on_scan(self, msg):
        self.rate.sleep()

    def on_command(self, msg):
        self.get_logger().info(msg.data)


def main():
    rclpy.init()
    executor = MultiThreadedExecutor()
    executor.add_node(Processor())
    executor.spin()


if __name__ == '__main__':
    main()

# finds: CC103:20 warning
