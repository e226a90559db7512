"""P41: a rate is a timer in a private reentrant group, one group for each node."""
# live: no, rates are of the library

import rclpy
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.rate = self.create_rate(10)
        self.slow = self.create_rate(1)
        self.create_timer(1.0, self.tick)

    def tick(self):
        self.rate.sleep()


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group rate_group REENTRANT library=rclpy.create_rate
#   group a_default EXCLUSIVE default
#   timer rate_timer in rate_group every 0.1 library=rclpy.create_rate
#   timer rate_timer_2 in rate_group every 1 library=rclpy.create_rate
#   timer tick in a_default every 1
#     blocks Rate.sleep on rate_timer @16
