"""Point 19: a ThreadPoolExecutor of the standard library is no ROS executor."""

from concurrent.futures import ThreadPoolExecutor

import rclpy
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.pool = ThreadPoolExecutor(max_workers=4)
        self.create_timer(0.5, self.tick)

    def tick(self):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 0.5
