"""P47, point 5: two nodes in one executor, two default groups."""

import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_timer(0.5, self.tick)

    def tick(self):
        pass


class B(Node):
    def __init__(self):
        super().__init__('b')
        self.create_timer(0.5, self.tick)

    def tick(self):
        pass


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(A())
    executor.add_node(B())
    executor.spin()


if __name__ == '__main__':
    main()

# expect:
# unit a_and_b: MultiThreadedExecutor x2 spin, main
#   nodes a, b
#   group a_default EXCLUSIVE default
#   group b_default EXCLUSIVE default
#   timer a_tick in a_default (A.tick) every 0.5 node=a
#   timer b_tick in b_default (B.tick) every 0.5 node=b
