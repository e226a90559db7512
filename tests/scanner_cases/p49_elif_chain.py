"""P49: every arm of an elif chain carries the mark of the whole."""
# live: no, depends on a parameter

import rclpy
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        mode = self.declare_parameter('mode', 'x').value
        if mode == 'x':
            self.create_timer(0.1, self.x)
        elif mode == 'y':
            self.create_timer(0.2, self.y)
        else:
            self.create_timer(0.3, self.z)

    def x(self):
        pass

    def y(self):
        pass

    def z(self):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer x in a_default every 0.1 conditional alternative@12.0
#   timer y in a_default every 0.2 conditional alternative@12.1
#   timer z in a_default every 0.3 conditional alternative@12.2
