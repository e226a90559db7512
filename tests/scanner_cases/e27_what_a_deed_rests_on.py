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
        self.create_timer(1.0, self.store_and_use)
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

    def store_and_use(self):
        if self.goal:
            return
        self.goal = object()
        self.goal.cancel()

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
#     reads A.count @23
#     writes A.count rests @25
#     writes A.state @26
#   timer by_test in a_default every 1
#     reads A.state @29
#     reads A.state @31
#     writes A.state rests @30
#     writes A.state @32
#   timer by_early_return in a_default every 1
#     reads A.goal @35
#     writes A.goal rests @38
#     writes A.goal clears @39
#   timer use in a_default every 1
#     reads A.goal @42
#     reads A.goal rests @44
#     reads A.goal @45
#   timer store_and_use in a_default every 1
#     reads A.goal @48
#     reads A.goal under A.goal (flag) @51
#     writes A.goal rests under A.goal (flag) @50
#   timer copy in a_default every 1
#     reads A.goal @54
#   timer items in a_default every 1
#     reads A.sides item 'left' @60
#     reads A.sides item 'right' @60
#     reads A.sides @62
#     reads A.state @62
#     writes A.sides update item 'left' @59
#     writes A.sides update in_place keeps_size item 'right' rests @60
#     writes A.sides update in_place item 'left' @61
#     writes A.sides update in_place @62
