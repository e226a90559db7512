"""A callback catches what its work raises, which being cancelled is not."""

import asyncio

import rclpy
from rclpy.experimental.async_node import AsyncNode


class Robot(AsyncNode):
    def __init__(self, name):
        super().__init__(name)
        self.create_timer(0.1, self.ask)

    async def ask(self):
        print('asks', flush=True)
        while True:
            try:
                await asyncio.sleep(0.1)
            except Exception:
                print('caught', flush=True)

    async def finished(self):
        await asyncio.sleep(1.5)


async def main():
    rclpy.init()
    async with Robot('robot') as node:
        await node.finished()
    print('goes on', flush=True)


asyncio.run(main())

# observed: goes on
# warned of: nothing
# broken: nothing
# undecided: nothing
