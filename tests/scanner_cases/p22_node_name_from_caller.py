"""P22: the literal is at the call."""

import rclpy
from rclpy.node import Node


class Arm(Node):
    def __init__(self, name):
        super().__init__(name + '_driver')
        self.create_timer(0.5, self.tick)

    def tick(self):
        pass


def main():
    rclpy.init()
    rclpy.spin(Arm('left'))


if __name__ == '__main__':
    main()

# expect:
# unit left_driver: SingleThreadedExecutor x1 rclpy.spin, main
#   group left_driver_default EXCLUSIVE default
#   timer tick in left_driver_default every 0.5
