"""A7: a node stops, since a second executor took it. Mended."""

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node


class Camera(Node):
    def __init__(self):
        super().__init__('camera')
        self.create_timer(0.1, self.grab)

    def grab(self):
        self.get_logger().info('grabs')


def main():
    rclpy.init()
    node = Camera()
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    executor.spin()


if __name__ == '__main__':
    main()

# finds: nothing
