"""P39, point 14: one callback function, several entries with names of their own."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_subscription(String, 'scan', self.on_msg, 10)
        self.create_subscription(String, 'odom', self.on_msg, 10)
        self.create_timer(1.0, self.on_msg)

    def on_msg(self, msg=None):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer on_msg in a_default every 1
#   subscription scan_on_msg in a_default (A.on_msg) key=scan
#   subscription odom_on_msg in a_default (A.on_msg) key=odom
