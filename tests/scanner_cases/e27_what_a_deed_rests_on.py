"""Deeds: which writes rest on what was read before, which uses on a test, which item is meant."""

import rclpy
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.count = 0
        self.goal = None
        self.state = 'idle'
        self.sides = {'left': 0, 'right': 0}
        self.create_timer(1.0, self.by_value)
        self.create_timer(1.0, self.by_test)
        self.create_timer(1.0, self.by_early_return)
        self.create_timer(1.0, self.use)
        self.create_timer(1.0, self.copy)
        self.create_timer(1.0, self.items)

    def by_value(self):
        before = self.count
        doubled = before * 2
        self.count = doubled + 1
        self.state = 'counted'

    def by_test(self):
        if self.state == 'idle':
            self.state = 'busy'
        self.get_logger().info(self.state)
        self.state = 'idle'

    def by_early_return(self):
        busy = self.goal is not None
        if busy:
            return
        self.goal = object()
        self.goal = None

    def use(self):
        if self.goal is None:
            return
        self.goal.cancel()
        self.get_logger().info(self.goal)

    def copy(self):
        goal = self.goal
        if goal is not None:
            goal.cancel()

    def items(self):
        self.sides['left'] += 1
        self.sides['right'] = self.sides['left']
        del self.sides['left']
        self.sides[self.state] = 0


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer by_value in a_default every 1
#     reads A.count @22
#     writes A.count rests @24
#     writes A.state @25
#   timer by_test in a_default every 1
#     reads A.state @28
#     reads A.state @30
#     writes A.state rests @29
#     writes A.state @31
#   timer by_early_return in a_default every 1
#     reads A.goal @34
#     writes A.goal rests @37
#     writes A.goal rests clears @38
#   timer use in a_default every 1
#     reads A.goal @41
#     reads A.goal rests @43
#     reads A.goal @44
#   timer copy in a_default every 1
#     reads A.goal @47
#   timer items in a_default every 1
#     reads A.sides item 'left' @53
#     reads A.sides item 'right' @53
#     reads A.sides @55
#     reads A.state @55
#     writes A.sides update item 'left' @52
#     writes A.sides update in_place keeps_size item 'right' rests @53
#     writes A.sides update in_place item 'left' @54
#     writes A.sides update in_place @55
