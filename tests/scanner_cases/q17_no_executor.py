"""Point 17: main makes a node and never spins: none found."""

import rclpy
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_timer(0.5, self.tick)

    def tick(self):
        pass


def main():
    rclpy.init()
    A()


if __name__ == '__main__':
    main()

# expect:
# unit a: no executor, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 0.5
#   ? executor executor
