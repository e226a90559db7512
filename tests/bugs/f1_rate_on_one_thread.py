"""F1: Rate.sleep never returns on one thread."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Driver(Node):
    def __init__(self):
        super().__init__('driver')
        self.create_subscription(String, 'go', self.on_go, 10)

    def on_go(self, msg):
        rate = self.create_rate(10)
        for _ in range(20):
            self.get_logger().info('drives')
            rate.sleep()


def main():
    rclpy.init()
    rclpy.spin(Driver())


if __name__ == '__main__':
    main()

# finds: CC105:17, CC501:11 note
