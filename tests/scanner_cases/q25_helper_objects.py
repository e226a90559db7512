"""Point 25: helper objects of one class are distinct, and one made in a callback is private."""

import rclpy
from rclpy.node import Node


class Filter:
    def __init__(self):
        self.last = 0.0

    def feed(self, value):
        self.last = self.last + value


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.left = Filter()
        self.right = Filter()
        self.create_timer(1.0, self.tick)

    def tick(self):
        self.left.feed(1.0)
        self.right.feed(1.0)
        mine = Filter()
        mine.feed(1.0)


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 1
#     reads A.left @23
#     reads Filter.last @23>12
#     reads A.right @24
#     reads Filter#2.last @24>12
#     writes Filter.last rests @23>12
#     writes Filter#2.last rests @24>12
