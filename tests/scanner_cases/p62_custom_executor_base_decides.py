"""P62: an executor subclass that overrides nothing schedules as its base."""

import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_timer(0.5, self.tick)

    def tick(self):
        pass


class Named(MultiThreadedExecutor):
    def __init__(self, name):
        super().__init__(num_threads=3)
        self.name = name


def main():
    rclpy.init()
    executor = Named('x')
    executor.add_node(A())
    executor.spin()


if __name__ == '__main__':
    main()

# expect:
# unit a: Named x3 spin, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 0.5
