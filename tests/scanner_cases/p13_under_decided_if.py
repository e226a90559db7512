"""P13: a condition that constants decide is no condition."""

import rclpy
from rclpy.node import Node


DEBUG = False
VERBOSE = True


class A(Node):
    def __init__(self):
        super().__init__('a')
        if DEBUG:
            self.create_timer(1.0, self.report)
        else:
            self.create_timer(0.5, self.tick)
        if VERBOSE and not DEBUG:
            self.create_timer(2.0, self.talk)

    def tick(self):
        pass

    def report(self):
        pass

    def talk(self):
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
#   timer talk in a_default every 2
