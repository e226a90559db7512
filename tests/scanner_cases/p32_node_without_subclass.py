"""P32: Node used directly."""

import rclpy
from rclpy.node import Node


def tick():
    pass


def main():
    rclpy.init()
    node = Node('a')
    node.create_timer(0.5, tick)
    rclpy.spin(node)


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 0.5
