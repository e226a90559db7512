"""A callback sleeps until a time given in the wrong unit."""

import rclpy
from rclpy.duration import Duration
from rclpy.node import Node


class Feeder(Node):
    def __init__(self):
        super().__init__('feeder')
        self.create_timer(0.3, self.feed)

    def feed(self):
        until = self.get_clock().now() + Duration(seconds=50)
        self.get_clock().sleep_until(until)  # waits here
        print('goes on')


def main():
    rclpy.init()
    rclpy.spin(Feeder())


if __name__ == '__main__':
    main()
