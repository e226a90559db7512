"""Point 23: an object with __call__."""
# live: no, an object without a qualified name

import time

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Handler:
    def __init__(self, name):
        self.name = name

    def __call__(self, msg):
        time.sleep(0.1)


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_subscription(String, 'in', Handler('x'), 10)


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   subscription Handler in a_default (Handler.__call__) key=in
#     blocks time.sleep 0.1 s @16
