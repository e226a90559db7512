"""A task that holds a lock of asyncio by `with` is cancelled, which gives it back."""

import asyncio

import rclpy
from rclpy.experimental.async_node import AsyncNode


class Robot(AsyncNode):
    def __init__(self, name):
        super().__init__(name)
        self.lock = asyncio.Lock()
        self.never = asyncio.Event()
        self.create_timer(0.1, self.ask)

    async def hold(self):
        async with self.lock:
            await self.never.wait()

    async def ask(self):
        print('asks', flush=True)
        task = asyncio.create_task(self.hold())
        await asyncio.sleep(0.01)
        task.cancel()
        async with self.lock:
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
# undecided: no deadlock, every wait ends, no starvation
