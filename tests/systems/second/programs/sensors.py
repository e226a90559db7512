"""Answers at once, from what it has read last."""

import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger


class Sensors(Node):
    def __init__(self):
        super().__init__('sensors')
        self.count = 0
        self.create_service(Trigger, '~/position', self.on_position)
        self.create_timer(0.1, self.read)

    def read(self):
        self.count += 1

    def on_position(self, request, response):
        response.success, response.message = True, str(self.count)
        return response


def main():
    rclpy.init()
    rclpy.spin(Sensors())


if __name__ == '__main__':
    main()
