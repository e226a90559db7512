"""D2: a coroutine callback dies, since no asyncio loop runs it. Mended."""

import rclpy
from rclpy.node import Node


class Gripper(Node):
    def __init__(self):
        super().__init__('gripper')
        self.create_timer(5.0, self.grip)

    def grip(self):
        self.get_logger().info('closes')
        self.later = self.create_timer(1.0, self.open)

    def open(self):
        self.later.cancel()
        self.get_logger().info('opens')


def main():
    rclpy.init()
    rclpy.spin(Gripper())


if __name__ == '__main__':
    main()

# finds: CC501:10 note
