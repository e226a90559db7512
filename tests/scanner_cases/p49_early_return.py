"""P49: what follows a return that may be taken is conditional."""
# live: no, depends on a parameter

import rclpy
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_timer(0.1, self.x)
        if self.declare_parameter('quiet', False).value:
            return
        self.create_timer(0.2, self.y)

    def x(self):
        pass

    def y(self):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer x in a_default every 0.1
#   timer y in a_default every 0.2 conditional
