"""Point 12: a condition inside a branch."""
# live: no, depends on a parameter

import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        sim = self.declare_parameter('sim', False).value
        if sim:
            if self.declare_parameter('fast', False).value:
                self.create_timer(0.1, self.one)
            self.create_timer(0.2, self.two)
        self.create_timer(0.3, self.three)

    def one(self):
        pass

    def two(self):
        pass

    def three(self):
        pass


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
#   timer one in a_default every 0.1 conditional
#   timer two in a_default every 0.2 conditional
#   timer three in a_default every 0.3
