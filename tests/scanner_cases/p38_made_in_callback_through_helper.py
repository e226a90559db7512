"""P38: made by a helper that a callback calls; the chain says so."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_subscription(String, 'cmd', self.on_cmd, 10)

    def on_cmd(self, msg):
        self.begin()

    def begin(self):
        self.create_timer(1.0, self.tick)

    def tick(self):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 1 conditional count=? when=callback
#   subscription on_cmd in a_default key=cmd
#     changes timer @14>17
#   ? tick count
