"""EffectLog: who asks first whether there is something to read does not wait for it."""

import os
import select
import sys

import rclpy
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_timer(1.0, self.key)
        self.create_timer(1.0, self.line)
        self.create_timer(1.0, self.rest)

    def key(self):
        ready, _, _ = select.select([sys.stdin], [], [], 0.0)
        if ready:
            self.get_logger().info(sys.stdin.read(1))

    def line(self):
        self.get_logger().info(sys.stdin.readline())

    def rest(self):
        os.set_blocking(0, False)
        self.get_logger().info(str(os.read(0, 100)))


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer key in a_default every 1
#   timer line in a_default every 1
#     blocks sys.stdin.readline @24
#   timer rest in a_default every 1
