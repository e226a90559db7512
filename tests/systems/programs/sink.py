"""Answers at once."""

import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger


class Sink(Node):
    def __init__(self):
        super().__init__('sink')
        self.create_service(Trigger, 'request', self.on_request)

    def on_request(self, request, response):
        return response


def main():
    rclpy.init()
    rclpy.spin(Sink())


if __name__ == '__main__':
    main()
