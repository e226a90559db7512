"""Answers at once."""

import rclpy
from example_interfaces.srv import AddTwoInts
from rclpy.node import Node


class Sink(Node):
    def __init__(self):
        super().__init__('sink')
        self.create_service(AddTwoInts, 'request', self.on_request)

    def on_request(self, request, response):
        return response


def main():
    rclpy.init()
    rclpy.spin(Sink())


if __name__ == '__main__':
    main()
