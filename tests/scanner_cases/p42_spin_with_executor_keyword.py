"""P42: the executor by keyword."""

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
    executor = MultiThreadedExecutor(num_threads=3)
    rclpy.spin(A(), executor=executor)


if __name__ == '__main__':
    main()

# expect:
# unit a: MultiThreadedExecutor x3 spin, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 0.5
