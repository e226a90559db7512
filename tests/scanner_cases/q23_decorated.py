"""Point 23: a decorated method keeps its name through functools.wraps."""

import functools
import time

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


def logged(function):
    @functools.wraps(function)
    def wrapper(self, *args):
        return function(self, *args)

    return wrapper


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_subscription(String, 'in', self.on_in, 10)

    @logged
    def on_in(self, msg):
        time.sleep(0.1)


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   subscription on_in in a_default key=in
#     blocks time.sleep 0.1 s @14>26
