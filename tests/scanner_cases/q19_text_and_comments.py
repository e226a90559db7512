"""Point 19: docstrings and comments are nothing."""

import rclpy
from rclpy.node import Node


class A(Node):
    """
    Use it so:

        self.create_timer(1.0, self.tick)
        rclpy.spin(node)
    """

    def __init__(self):
        super().__init__('a')
        # self.create_timer(2.0, self.tick)
        text = 'self.create_subscription(String, "x", self.on_x, 10)'
        self.get_logger().info(text)


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
