"""A coroutine callback awaits asyncio.sleep, for which no loop runs."""

import asyncio

import rclpy
from rclpy.node import Node


class Blinker(Node):
    def __init__(self):
        super().__init__('blinker')
        self.create_timer(0.4, self.blink)

    async def blink(self):
        await asyncio.sleep(0.1)  # breaks here
        print('goes on')


def main():
    rclpy.init()
    rclpy.spin(Blinker())


if __name__ == '__main__':
    main()
