"""EffectLog: a callback that adds a node to an executor."""

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node


class A(Node):
    def __init__(self, executor):
        super().__init__('a')
        self.own = executor
        self.create_timer(1.0, self.tick)

    def tick(self):
        self.own.add_node(Node('late'))


def main():
    rclpy.init()
    executor = SingleThreadedExecutor()
    executor.add_node(A(executor))
    executor.spin()


if __name__ == '__main__':
    main()

# expect:
# unit a_and_late: SingleThreadedExecutor x1 spin, main
#   nodes a, late
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 1 node=a
#     changes add_node @15
