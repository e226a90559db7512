"""Point 23: a name-mangled method keeps its source name."""

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.__group = ReentrantCallbackGroup()
        self.create_timer(0.5, self.__cb, callback_group=self.__group)

    def __cb(self):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group __group REENTRANT
#   timer __cb in __group every 0.5
