"""Point 28: a constructor that raises, as far as it can be followed, may make more."""
# live: no, it does raise

import rclpy
from rclpy.node import Node

LIMIT = 0


class Limited(Node):
    def __init__(self):
        super().__init__('limited')
        self.create_timer(1.0, self.tick)
        if not LIMIT:
            raise ValueError('no limit')
        self.create_timer(2.0, self.tick)

    def tick(self):
        pass


def main():
    rclpy.init()
    rclpy.spin(Limited())


if __name__ == '__main__':
    main()

# expect:
# unit limited: SingleThreadedExecutor x1 rclpy.spin, main
#   group limited_default EXCLUSIVE default
#   timer tick in limited_default every 1
#   ? limited entities
