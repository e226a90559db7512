"""E1: nothing runs in parallel, since one thread runs it all."""

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.node import Node
from std_msgs.msg import String


class Driver(Node):
    def __init__(self):
        super().__init__('driver')
        group = ReentrantCallbackGroup()
        self.create_timer(0.1, self.control, callback_group=group)
        self.create_subscription(String, 'stop', self.on_stop, 10, callback_group=group)

    def control(self):
        self.get_logger().info('controls')

    def on_stop(self, msg):
        self.get_logger().info('stops')


def main():
    rclpy.init()
    rclpy.spin(Driver())


if __name__ == '__main__':
    main()

# finds: CC402:12 note
