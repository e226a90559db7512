"""P5: the base class is initialised by its name, Node.__init__(self, ...)."""

import rclpy
from rclpy.node import Node


class A(Node):
    def __init__(self):
        Node.__init__(self, 'a')
        self.create_timer(0.5, self.tick)

    def tick(self):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 0.5
