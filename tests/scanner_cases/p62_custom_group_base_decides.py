"""P62: a subclass that overrides nothing is what its base is."""
# live: no, another class name

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.node import Node


class Named(ReentrantCallbackGroup):
    def __init__(self, name):
        super().__init__()
        self.name = name


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.g = Named('g')
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
#   group g REENTRANT class=Named
#   timer tick in g every 1
