"""A callback awaits an event that nobody sets."""

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
        await self.event.wait()
        print('goes on', flush=True)

    async def finished(self):
        await asyncio.sleep(1.5)


async def main():
    rclpy.init()
    async with Robot('robot') as node:
        await node.finished()


asyncio.run(main())

# observed: hangs
# warned of: CC109
# broken: no deadlock, every wait ends
# undecided: nothing
