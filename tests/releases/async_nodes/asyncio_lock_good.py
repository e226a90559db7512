"""Two callbacks take a lock of asyncio."""

import asyncio

import rclpy
from rclpy.experimental.async_node import AsyncNode


class Robot(AsyncNode):
    def __init__(self, name):
        super().__init__(name)
        self.lock = asyncio.Lock()
        self.n = 0
        self.create_timer(0.1, self.ask)
        self.create_timer(0.1, self.tick)

    async def ask(self):
        async with self.lock:
            print('asks', flush=True)
            await asyncio.sleep(0.05)
            self.n += 1
            print('goes on', flush=True)

    async def tick(self):
        async with self.lock:
            self.n += 1

    async def finished(self):
        await asyncio.sleep(1.0)


async def main():
    rclpy.init()
    async with Robot('robot') as node:
        await node.finished()


asyncio.run(main())

# observed: goes on
# warned of: nothing
# broken: nothing
# undecided: nothing
