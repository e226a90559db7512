"""A thread lets the loop set an event of asyncio."""

import asyncio
import threading
import time

import rclpy
from rclpy.experimental.async_node import AsyncNode


class Robot(AsyncNode):
    def __init__(self, name):
        super().__init__(name)
        self.event = asyncio.Event()
        self.timer = self.create_timer(0.1, self.ask)

    async def ask(self):
        print('asks', flush=True)
        self.timer.cancel()
        loop = asyncio.get_running_loop()
        threading.Thread(target=self.work, args=(loop,), daemon=True).start()
        await self.event.wait()
        print('goes on', flush=True)

    def work(self, loop):
        time.sleep(0.2)
        loop.call_soon_threadsafe(self.event.set)

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
