"""D2: a coroutine callback dies, since no asyncio loop runs it."""

import asyncio

import rclpy
from rclpy.node import Node


class Gripper(Node):
    def __init__(self):
        super().__init__('gripper')
        self.create_timer(5.0, self.grip)

    async def grip(self):
        self.get_logger().info('closes')
        await asyncio.sleep(1.0)
        self.get_logger().info('opens')


def main():
    rclpy.init()
    rclpy.spin(Gripper())


if __name__ == '__main__':
    main()

# finds: CC108:16
