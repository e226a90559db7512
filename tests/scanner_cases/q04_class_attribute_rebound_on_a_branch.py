"""Point 4: what the class gives stays on the branch that sets no attribute of the object."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.node import Node


class A(Node):
    extra = None
    group = MutuallyExclusiveCallbackGroup()

    def __init__(self):
        super().__init__('a')
        if self.declare_parameter('fast', False).value:
            self.extra = 0.5
            self.group = ReentrantCallbackGroup()
            self.tick = self.tock
        if not self.extra:
            self.create_timer(1.0, self.slow)
        self.create_timer(2.0, self.tick, callback_group=self.group)

    def slow(self):
        pass

    def tick(self):
        pass

    def tock(self):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   group unresolved_1 EXCLUSIVE UNRESOLVED
#   timer slow in a_default every 1 conditional
#   timer tock_or_tick in unresolved_1 every 2 UNRESOLVED
#   ? tock_or_tick function
#   ? unresolved_1 group
