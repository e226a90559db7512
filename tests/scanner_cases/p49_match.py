"""P49: the cases of a match statement are alternatives."""
# live: no, depends on a parameter

import rclpy
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        mode = self.declare_parameter('mode', 'x').value
        match mode:
            case 'x':
                self.create_timer(0.1, self.x)
            case _:
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
#   timer x in a_default every 0.1 conditional alternative@12.0
#   timer y in a_default every 0.2 conditional alternative@12.1
