"""F1: Rate.sleep never returns on one thread. Mended."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Driver(Node):
    def __init__(self):
        super().__init__('driver')
        self.steps = 0
        self.create_subscription(String, 'go', self.on_go, 10)
        self.create_timer(0.1, self.drive)

    def on_go(self, msg):
        self.steps = 20

    def drive(self):
        if self.steps > 0:
            self.steps -= 1
            self.get_logger().info('drives')


def main():
    rclpy.init()
    rclpy.spin(Driver())


if __name__ == '__main__':
    main()

# finds: nothing
