"""A lock that its holder takes once more is not waited for: the other order is none."""

import threading

import rclpy
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.store = threading.RLock()
        self.shelf = threading.RLock()
        self.create_timer(1.0, self.move)

    def move(self):
        with self.store:
            with self.shelf:
                self.total()

    def total(self):
        with self.store:
            pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer move in a_default every 1
#     locks store @17
#     locks shelf holding store @18
