"""The message 'stop' ends the node from within its callback."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Robot(Node):
    def __init__(self):
        super().__init__('robot')
        self.orders = self.create_publisher(String, 'orders', 10)
        self.create_subscription(String, 'orders', self.on_order, 10)
        self.create_timer(0.5, self.give)

    def give(self):
        self.orders.publish(String(data='stop'))

    def on_order(self, message):
        print(message.data, flush=True)
        if message.data == 'stop':
            # differs: shutdown-waits-not
            rclpy.shutdown()
            print('shut down', flush=True)


def main():
    rclpy.init()
    rclpy.spin(Robot())
    print('spin is over', flush=True)


if __name__ == '__main__':
    main()
