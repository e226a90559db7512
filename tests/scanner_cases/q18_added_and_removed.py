"""Point 18: added to one executor, removed, added to another."""

import rclpy
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
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
    first = MultiThreadedExecutor(num_threads=2)
    first.add_node(node)
    first.remove_node(node)
    second = SingleThreadedExecutor()
    second.add_node(node)
    second.spin()


if __name__ == '__main__':
    main()

# expect:
# unit a: second=SingleThreadedExecutor x1 spin, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 0.5
