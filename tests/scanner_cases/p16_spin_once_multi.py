"""P16: spin_once of a multi-threaded executor keeps its threads."""

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
    executor.add_node(A())
    while rclpy.ok():
        executor.spin_once(timeout_sec=0.1)


if __name__ == '__main__':
    main()

# expect:
# unit a: MultiThreadedExecutor x3 spin_once, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 0.5
