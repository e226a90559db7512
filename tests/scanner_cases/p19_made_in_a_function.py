"""P19: a module-level function makes the entities."""

import rclpy
from rclpy.node import Node


def tick():
    pass


def set_up(node, period):
    return node.create_timer(period, tick)


def main():
    rclpy.init()
    node = Node('a')
    set_up(node, 0.5)
    set_up(node, 0.7)
    rclpy.spin(node)


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 0.5
#   timer tick_2 in a_default (tick) every 0.7
