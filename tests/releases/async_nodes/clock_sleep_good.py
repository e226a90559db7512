"""A callback sleeps by the clock of the node, and others run meanwhile."""

import asyncio

import rclpy
from rclpy.experimental.async_node import AsyncNode


class Robot(AsyncNode):
    def __init__(self, name):
        super().__init__(name)
        self.ticks = 0
        self.create_timer(0.1, self.ask)
        self.create_timer(0.05, self.tick)

    async def ask(self):
        print('asks', flush=True)
        before = self.ticks
        await self.get_clock().sleep(0.4)
        print('goes on' if self.ticks > before else 'late', flush=True)

    def tick(self):
        self.ticks += 1

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
