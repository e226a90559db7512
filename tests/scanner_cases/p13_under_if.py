"""P13: made under a condition nobody can decide."""
# live: no, depends on a parameter

import rclpy
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.declare_parameter('debug', False)
        self.create_timer(0.5, self.tick)
        if self.get_parameter('debug').value:
            self.create_timer(1.0, self.report)

    def tick(self):
        pass

    def report(self):
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
#   timer report in a_default every 1 conditional
