"""P60: one executor spun in exclusive branches is one unit."""
# live: no, the mode depends on the command line

import sys

import rclpy
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.done = False
        self.create_timer(1.0, self.tick)

    def tick(self):
        self.done = True


def main():
    rclpy.init()
    node = A()
    mode = sys.argv[1]
    if mode == 'a':
        while not node.done:
            rclpy.spin_once(node)
    elif mode == 'b':
        rclpy.spin_once(node)
    else:
        rclpy.spin(node)


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 1
#     writes A.done @17
