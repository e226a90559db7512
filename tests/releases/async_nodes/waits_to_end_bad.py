"""A callback that is cancelled waits for something else before it ends: the node is never left."""

import asyncio

import rclpy
from rclpy.experimental.async_node import AsyncNode


class Robot(AsyncNode):
    def __init__(self, name):
        super().__init__(name)
        self.never = asyncio.Event()
        self.create_timer(0.1, self.ask)

    async def ask(self):
        print('asks', flush=True)
        try:
            await asyncio.sleep(10.0)
        finally:
            await self.never.wait()

    async def finished(self):
        await asyncio.sleep(1.5)


async def main():
    rclpy.init()
    async with Robot('robot') as node:
        await node.finished()
    print('goes on', flush=True)


asyncio.run(main())

# observed: hangs
# warned of: CC109
# broken: no deadlock, every wait ends
# undecided: nothing
