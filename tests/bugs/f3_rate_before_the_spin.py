"""F3: sleeps by a Rate in the constructor, before anybody spins."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Driver(Node):
    def __init__(self):
        super().__init__('driver')
        self.create_subscription(String, 'go', self.on_go, 10)
        self.create_rate(1.0).sleep()

    def on_go(self, msg):
        self.get_logger().info(msg.data)


def main():
    rclpy.init()
    rclpy.spin(Driver())


if __name__ == '__main__':
    main()

# finds: CC110:12
