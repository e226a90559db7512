"""Point 24: an update from the old value, and one that CPython does in one piece, are distinct."""

import rclpy
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.log, self.best = [], {}
        self.count = 0
        self.create_timer(1.0, self.tick)

    def tick(self):
        self.log.append(1)
        self.best['x'] = 1
        self.best['x'] += 1
        self.count += 1


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 1
#     reads A.best item 'x' @16
#     writes A.log update in_place @15
#     writes A.best update in_place item 'x' @16
#     writes A.best update item 'x' @17
#     writes A.count update @18
