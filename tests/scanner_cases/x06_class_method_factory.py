"""Hard: a class method makes the node."""

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.node import Node


class A(Node):
    def __init__(self, name, group):
        super().__init__(name)
        self.create_timer(0.5, self.tick, callback_group=group)

    @classmethod
    def reentrant(cls, name='a'):
        return cls(name, ReentrantCallbackGroup())

    def tick(self):
        pass


def main():
    rclpy.init()
    rclpy.spin(A.reentrant())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group tick_group REENTRANT
#   timer tick in tick_group every 0.5
