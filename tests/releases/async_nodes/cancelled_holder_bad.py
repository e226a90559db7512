"""A task that holds a lock of asyncio without `with` is cancelled, and keeps it."""

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
        await self.lock.acquire()
        await self.never.wait()
        self.lock.release()

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

# observed: hangs
# warned of: nothing
# broken: nothing
# undecided: no deadlock, every wait ends, no starvation
