"""EffectLog: connecting a datagram socket asks nobody, so that it does not wait."""

import socket

import rclpy
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_timer(1.0, self.address)
        self.create_timer(1.0, self.ask)

    def address(self):
        probe = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        probe.connect(('192.0.2.1', 80))
        self.get_logger().info(probe.getsockname()[0])

    def ask(self):
        line = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
        line.connect(('192.0.2.1', 80))


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer address in a_default every 1
#   timer ask in a_default every 1
#     blocks socket.connect @22
