"""A loop over a list that it fills itself waits for nobody; one that somebody else fills does."""

import time

import rclpy
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_timer(1.0, self.grow)

    def grow(self):
        grown = []
        while len(grown) < 5:
            grown.append(1)
            time.sleep(0.1)


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer grow in a_default every 1
#     blocks time.sleep 0.1 s @18
