"""P59: the group as third argument of create_timer and second of a guard condition."""

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.g = ReentrantCallbackGroup()
        self.create_timer(1.0, self.tick, self.g)
        self.create_guard_condition(self.on_guard, self.g)

    def tick(self):
        pass

    def on_guard(self):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group g REENTRANT
#   timer tick in g every 1
#   guard_condition on_guard in g
