"""EffectLog: an attribute that only callbacks make is shared data too."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_timer(1.0, self.tick)
        self.create_subscription(String, 'x', self.on_x, 10)
        self.create_subscription(String, 'y', self.on_y, 10)

    def tick(self):
        if self.count_publishers('x'):
            self.get_logger().info(self.last.data)

    def on_x(self, msg):
        self.last = msg
        self.extra = self.create_timer(1.0, self.tick)

    def on_y(self, msg):
        self.last = None


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 1
#     reads A.last @17
#   timer tick_2 in a_default (A.tick) every 1 conditional count=? when=callback
#     reads A.last @17
#   subscription on_x in a_default key=x
#     writes A.last @20
#     writes A.extra @21
#     changes timer @21
#   subscription on_y in a_default key=y
#     writes A.last clears @24
#   ? tick_2 count
