"""EffectLog: which writes rest on what was read before, which uses on a test, which item is meant."""

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
        self.create_timer(1.0, self.use_later)
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

    def use_later(self):
        if self.goal is not None:
            self.get_logger().info('busy')
            self.goal.cancel()

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
#     reads A.count @24
#     writes A.count rests @26
#     writes A.state @27
#   timer by_test in a_default every 1
#     reads A.state @30
#     reads A.state @32
#     writes A.state rests constant under A.state (flag) @31
#     writes A.state @33
#   timer by_early_return in a_default every 1
#     reads A.goal @36
#     writes A.goal rests @39
#     writes A.goal clears @40
#   timer use in a_default every 1
#     reads A.goal @43
#     reads A.goal rests @45
#     reads A.goal @46
#   timer use_later in a_default every 1
#     reads A.goal @49
#     reads A.goal rests later @51
#   timer store_and_use in a_default every 1
#     reads A.goal @54
#     reads A.goal under A.goal (flag) @57
#     writes A.goal rests under A.goal (flag) @56
#   timer copy in a_default every 1
#     reads A.goal @60
#   timer items in a_default every 1
#     reads A.sides item 'left' @66
#     reads A.sides item 'right' @66
#     reads A.sides @68
#     reads A.state @68
#     writes A.sides update item 'left' @65
#     writes A.sides update in_place keeps_size item 'right' rests @66
#     writes A.sides update in_place item 'left' @67
#     writes A.sides update in_place @68
