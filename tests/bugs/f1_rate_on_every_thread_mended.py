"""F1: one scan sleeps at a time, and a thread is left for the timer of the rate."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from sensor_msgs.msg import LaserScan
from std_msgs.msg import String


class Processor(Node):
    def __init__(self):
        super().__init__('processor')
        self.rate = self.create_rate(1.0)
        scans = MutuallyExclusiveCallbackGroup()
        self.create_subscription(LaserScan, 'scan', self.on_scan, 10, callback_group=scans)
        self.create_subscription(String, 'command', self.on_command, 10)

    def on_scan(self, msg):
        self.rate.sleep()

    def on_command(self, msg):
        self.get_logger().info(msg.data)


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=3)
    executor.add_node(Processor())
    executor.spin()


if __name__ == '__main__':
    main()

# finds: nothing
