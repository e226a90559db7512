"""Point 3: a = b = Group() is one group, a, b = Group(), Group() are two."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        a = b = MutuallyExclusiveCallbackGroup()
        c, d = MutuallyExclusiveCallbackGroup(), MutuallyExclusiveCallbackGroup()
        self.create_timer(0.1, self.one, callback_group=a)
        self.create_timer(0.2, self.two, callback_group=b)
        self.create_timer(0.3, self.three, callback_group=c)
        self.create_timer(0.4, self.four, callback_group=d)

    def one(self):
        pass

    def two(self):
        pass

    def three(self):
        pass

    def four(self):
        pass


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(A())
    executor.spin()


if __name__ == '__main__':
    main()

# expect:
# unit a: MultiThreadedExecutor x2 spin, main
#   group a_2 EXCLUSIVE
#   group c EXCLUSIVE
#   group d EXCLUSIVE
#   timer one in a_2 every 0.1
#   timer two in a_2 every 0.2
#   timer three in c every 0.3
#   timer four in d every 0.4
