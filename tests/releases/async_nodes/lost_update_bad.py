"""Two callbacks read a number, await, and write it."""

import asyncio

import rclpy
from rclpy.experimental.async_node import AsyncNode


class Robot(AsyncNode):
    def __init__(self, name):
        super().__init__(name)
        self.n = 0
        self.runs = 0
        self.create_timer(0.1, self.ask)
        self.create_timer(0.1, self.tick)

    async def ask(self):
        print('asks', flush=True)
        n = self.n
        await asyncio.sleep(0.02)
        self.n = n + 1
        self.runs += 1

    async def tick(self):
        n = self.n
        await asyncio.sleep(0.02)
        self.n = n + 1
        self.runs += 1

    async def finished(self):
        await asyncio.sleep(1.0)
        print('loses' if self.n < self.runs else 'goes on', flush=True)


async def main():
    rclpy.init()
    async with Robot('robot') as node:
        await node.finished()


asyncio.run(main())

# observed: loses
# warned of: CC301
# broken: no data race
# undecided: nothing
