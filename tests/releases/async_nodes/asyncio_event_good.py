"""An event of asyncio is awaited, and another callback sets it."""

import asyncio

import rclpy
from rclpy.experimental.async_node import AsyncNode


class Robot(AsyncNode):
    def __init__(self, name):
        super().__init__(name)
        self.event = asyncio.Event()
        self.create_timer(0.1, self.ask)
        self.create_timer(0.2, self.tick)

    async def ask(self):
        print('asks', flush=True)
        await self.event.wait()
        print('goes on', flush=True)

    async def tick(self):
        print('tick', flush=True)
        self.event.set()

    async def finished(self):
        await asyncio.sleep(1.5)


async def main():
    rclpy.init()
    async with Robot('robot') as node:
        await node.finished()


asyncio.run(main())

# observed: goes on
# warned of: nothing
# broken: nothing
# undecided: nothing
