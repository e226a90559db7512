"""Hard: groups stored by setattr."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        for name in ('fast', 'slow'):
            setattr(self, f'{name}_group', MutuallyExclusiveCallbackGroup())
        self.create_timer(0.1, self.fast, callback_group=self.fast_group)
        self.create_timer(1.0, self.slow, callback_group=self.slow_group)

    def fast(self):
        pass

    def slow(self):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group fast_group EXCLUSIVE
#   group slow_group EXCLUSIVE
#   timer fast in fast_group every 0.1
#   timer slow in slow_group every 1
