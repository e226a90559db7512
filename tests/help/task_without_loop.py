"""A callback makes a task of asyncio, and no loop runs in its thread."""

import asyncio

import rclpy
from rclpy.node import Node


class Uploader(Node):
    def __init__(self):
        super().__init__('uploader')
        self.create_timer(0.3, self.on_picture)

    def on_picture(self):
        self.task = asyncio.create_task(self.upload())

    async def upload(self):
        await asyncio.sleep(0.1)
        print('goes on', flush=True)


def main():
    rclpy.init()
    rclpy.spin(Uploader())


if __name__ == '__main__':
    main()
