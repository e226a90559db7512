"""Point 16: the resolution order of a diamond."""

import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Base(Node):
    def __init__(self, **kwargs):
        super().__init__('a', **kwargs)
        self.create_timer(0.5, self.tick)

    def tick(self):
        pass


class Left(Base):
    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.create_timer(0.6, self.left)

    def left(self):
        pass


class Right(Base):
    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.create_timer(0.7, self.right)

    def right(self):
        pass

    def tick(self):
        pass


class A(Left, Right):
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
#   timer tick in a_default every 0.5
#   timer right in a_default every 0.7
#   timer left in a_default every 0.6
