"""The end of a chain: answers at once."""

import rclpy
from rclpy.node import Node
from std_srvs.srv import SetBool


class Anchor(Node):
    def __init__(self):
        super().__init__('anchor')
        self.create_service(SetBool, 'set', self.on_set)

    def on_set(self, request, response):
        response.success = True
        return response


def main():
    rclpy.init()
    rclpy.spin(Anchor())


if __name__ == '__main__':
    main()
