"""A callback sleeps until its publisher has a subscriber, and nobody subscribes. Mended."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Beacon(Node):
    def __init__(self):
        super().__init__('beacon')
        self.publisher = self.create_publisher(String, 'beacon', 10)
        self.create_timer(0.5, self.send)

    def send(self):
        if self.publisher.get_subscription_count() == 0:
            print('goes on')
            return
        self.publisher.publish(String())
        print('goes on')


def main():
    rclpy.init()
    rclpy.spin(Beacon())


if __name__ == '__main__':
    main()
