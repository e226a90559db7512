"""Point 1: rclpy.spin after filling a multi-threaded executor: one thread, and a warning."""

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
    node = A()
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(node)
    rclpy.spin(node)


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 0.5
# warning executor-not-spun @22
