"""A callback awaits a future of rclpy."""

import asyncio

import rclpy
from rclpy.experimental.async_node import AsyncNode
from rclpy.task import Future


class Robot(AsyncNode):
    def __init__(self, name):
        super().__init__(name)
        self.future = Future()
        self.create_timer(0.1, self.ask)
        self.create_timer(0.2, self.tick)

    async def ask(self):
        print('asks', flush=True)
        await self.future
        print('goes on', flush=True)

    async def tick(self):
        print('tick', flush=True)
        self.future.set_result(None)

    async def finished(self):
        await asyncio.sleep(1.5)


async def main():
    rclpy.init()
    async with Robot('robot') as node:
        await node.finished()


asyncio.run(main())

# observed: raises
# warned of: CC114
# broken: every wait ends
# undecided: nothing
