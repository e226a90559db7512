"""A callback awaits what another one puts into a queue of asyncio."""

import asyncio

import rclpy
from rclpy.experimental.async_node import AsyncNode


class Robot(AsyncNode):
    def __init__(self, name):
        super().__init__(name)
        self.queue = asyncio.Queue()
        self.create_timer(0.1, self.ask)
        self.create_timer(0.2, self.tick)

    async def ask(self):
        print('asks', flush=True)
        await self.queue.get()
        print('goes on', flush=True)

    async def tick(self):
        self.queue.put_nowait(1)

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
