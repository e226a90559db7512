"""P62, point 8: a custom group class is unresolved, also when its name resembles a known one."""
# live: no, unresolved

import rclpy
from rclpy.callback_groups import CallbackGroup
from rclpy.node import Node


class NonReentrantCallbackGroup(CallbackGroup):
    def can_execute(self, entity):
        return True

    def beginning_execution(self, entity):
        return True

    def ending_execution(self, entity):
        pass


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.g = NonReentrantCallbackGroup()
        self.create_timer(1.0, self.tick, callback_group=self.g)

    def tick(self):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group g EXCLUSIVE class=NonReentrantCallbackGroup UNRESOLVED
#   timer tick in g every 1
#   ? g group
