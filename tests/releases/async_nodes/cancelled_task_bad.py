"""A callback awaits the task that it has cancelled: that ends its timer too."""

import asyncio

import rclpy
from rclpy.experimental.async_node import AsyncNode


class Robot(AsyncNode):
    def __init__(self, name):
        super().__init__(name)
        self.runs = 0
        self.create_timer(0.1, self.ask)

    async def ask(self):
        print('goes on' if self.runs else 'asks', flush=True)
        self.runs += 1
        task = asyncio.create_task(asyncio.sleep(10.0))
        await asyncio.sleep(0.01)
        task.cancel()
        await task

    async def finished(self):
        await asyncio.sleep(1.5)


async def main():
    rclpy.init()
    async with Robot('robot') as node:
        await node.finished()


asyncio.run(main())

# observed: hangs
# warned of: nothing
# broken: nothing
# undecided: nothing
