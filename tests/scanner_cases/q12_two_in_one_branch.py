"""Point 12: both entities of one branch carry the mark of the statement."""
# live: no, depends on a parameter

import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        if self.declare_parameter('sim', False).value:
            self.create_timer(0.1, self.one)
            self.create_timer(0.2, self.two)
        else:
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
#   timer one in a_default every 0.1 conditional alternative@12.0
#   timer two in a_default every 0.2 conditional alternative@12.0
#   timer three in a_default every 0.3 conditional alternative@12.1
