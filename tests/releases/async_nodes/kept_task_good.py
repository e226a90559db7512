"""A callback starts a task and keeps it, and another one awaits it."""

import asyncio

import rclpy
from rclpy.experimental.async_node import AsyncNode


class Robot(AsyncNode):
    def __init__(self, name):
        super().__init__(name)
        self.task = None
        self.create_timer(0.1, self.start)
        self.create_timer(0.2, self.ask)

    async def work(self):
        await asyncio.sleep(0.3)

    async def start(self):
        if self.task is None:
            self.task = asyncio.create_task(self.work())

    async def ask(self):
        print('asks', flush=True)
        if self.task is not None:
            await self.task
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
