"""A7: a node stops, since a second executor took it."""

import threading

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
    threading.Thread(target=executor.spin, daemon=True).start()
    rclpy.spin(node)


if __name__ == '__main__':
    main()

# finds: CC406:25 warning
