"""Asks somebody else before it answers, on its only thread: the answer never gets through."""

import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger


class Stuck(Node):
    def __init__(self):
        super().__init__('stuck')
        self.next = self.create_client(Trigger, 'next')
        self.create_service(Trigger, 'first/request', self.on_request)

    def on_request(self, request, response):
        self.next.call(Trigger.Request())
        return response


def main():
    rclpy.init()
    rclpy.spin(Stuck())


if __name__ == '__main__':
    main()
