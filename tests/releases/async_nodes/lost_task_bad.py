"""A callback starts a task that nobody keeps, and its exception is lost."""

import asyncio

import rclpy
from rclpy.experimental.async_node import AsyncNode


class Robot(AsyncNode):
    def __init__(self, name):
        super().__init__(name)
        self.create_timer(0.1, self.ask)

    async def work(self):
        raise ValueError('mine')

    async def ask(self):
        print('asks', flush=True)
        asyncio.create_task(self.work())  # noqa: RUF006
        print('loses', flush=True)

    async def finished(self):
        await asyncio.sleep(1.5)


async def main():
    rclpy.init()
    async with Robot('robot') as node:
        await node.finished()


asyncio.run(main())

# observed: loses
# warned of: CC123
# broken: nothing
# undecided: nothing
