"""Point 16: the subclass method is the callback of what the base class creates."""

import time

import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Base(Node):
    def __init__(self, name):
        super().__init__(name)
        self.create_timer(0.5, self.tick)

    def tick(self):
        raise NotImplementedError


class A(Base):
    def __init__(self):
        super().__init__('a')

    def tick(self):
        time.sleep(0.1)


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(A())
    executor.spin()


if __name__ == '__main__':
    main()

# expect:
# unit a: MultiThreadedExecutor x2 spin, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 0.5
#     blocks time.sleep 0.1 s @24
