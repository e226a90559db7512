"""The program awaits what a callback sets."""

import asyncio

import rclpy
from rclpy.experimental.async_node import AsyncNode


class Robot(AsyncNode):
    def __init__(self, name):
        super().__init__(name)
        self.event = asyncio.Event()
        self.create_timer(0.1, self.tick)

    def tick(self):
        self.event.set()


async def main():
    rclpy.init()
    async with Robot('robot') as node:
        print('asks', flush=True)
        await node.event.wait()
        print('goes on', flush=True)


asyncio.run(main())

# observed: goes on
# warned of: nothing
# broken: nothing
# undecided: nothing
