"""An exception in a callback ends the node."""

import asyncio

import rclpy
from rclpy.experimental.async_node import AsyncNode


class Robot(AsyncNode):
    def __init__(self, name):
        super().__init__(name)
        self.create_timer(0.1, self.ask)
        self.create_timer(0.05, self.tick)

    async def ask(self):
        print('asks', flush=True)
        raise ValueError('mine')

    async def tick(self):
        print('tick', flush=True)

    async def finished(self):
        await asyncio.sleep(1.0)
        print('goes on', flush=True)


async def main():
    rclpy.init()
    async with Robot('robot') as node:
        await node.finished()


asyncio.run(main())

# observed: raises
# warned of: nothing
# broken: nothing
# undecided: nothing
