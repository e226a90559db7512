"""F3: a thread spins the node before the program sleeps by a Rate."""

import threading

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Driver(Node):
    def __init__(self):
        super().__init__('driver')
        self.create_subscription(String, 'go', self.on_go, 10)

    def on_go(self, msg):
        self.get_logger().info(msg.data)


def main():
    rclpy.init()
    driver = Driver()
    threading.Thread(target=rclpy.spin, args=(driver,)).start()
    rate = driver.create_rate(1.0)
    while rclpy.ok():
        driver.get_logger().info('waits')
        rate.sleep()


if __name__ == '__main__':
    main()

# finds: nothing
