"""A callback awaits what nobody sets, but not forever."""

import asyncio

import rclpy
from rclpy.experimental.async_node import AsyncNode


class Robot(AsyncNode):
    def __init__(self, name):
        super().__init__(name)
        self.event = asyncio.Event()
        self.create_timer(0.1, self.ask)

    async def ask(self):
        print('asks', flush=True)
        try:
            async with asyncio.timeout(0.2):
                await self.event.wait()
        except TimeoutError:
            print('goes on', flush=True)

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
