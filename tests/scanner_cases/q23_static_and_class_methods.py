"""Point 23: static and class methods."""

import rclpy
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_timer(0.5, self.on_static)
        self.create_timer(0.6, A.on_static_too)
        self.create_timer(0.7, self.on_class)

    @staticmethod
    def on_static():
        pass

    @staticmethod
    def on_static_too():
        pass

    @classmethod
    def on_class(cls):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer on_static in a_default every 0.5
#   timer on_static_too in a_default every 0.6
#   timer on_class in a_default every 0.7
