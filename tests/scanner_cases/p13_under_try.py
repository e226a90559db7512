"""P13: in the body of a try, as if nothing went wrong; in its handler, conditional."""
# live: no, nothing goes wrong

import rclpy
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        try:
            self.create_timer(0.5, self.tick)
        except ValueError:
            self.create_timer(1.0, self.slow)

    def tick(self):
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
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 0.5
#   timer slow in a_default every 1 conditional
