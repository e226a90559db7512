"""P42: the executor is the second argument of rclpy.spin."""

import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_timer(0.5, self.tick)

    def tick(self):
        pass


def main():
    rclpy.init()
    rclpy.spin(A(), MultiThreadedExecutor())


if __name__ == '__main__':
    main()

# expect:
# unit a: MultiThreadedExecutor xdefault spin, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 0.5
