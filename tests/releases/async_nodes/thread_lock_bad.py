"""A lock of threading is kept over an await, and another callback blocks on it."""

import asyncio
import threading

import rclpy
from rclpy.experimental.async_node import AsyncNode


class Robot(AsyncNode):
    def __init__(self, name):
        super().__init__(name)
        self.lock = threading.Lock()
        self.create_timer(0.1, self.ask)
        self.create_timer(0.12, self.tick)

    async def ask(self):
        with self.lock:
            print('asks', flush=True)
            await asyncio.sleep(0.2)
        print('goes on', flush=True)

    async def tick(self):
        with self.lock:
            print('tick', flush=True)

    async def finished(self):
        await asyncio.sleep(1.5)


async def main():
    rclpy.init()
    async with Robot('robot') as node:
        await node.finished()


asyncio.run(main())

# observed: hangs
# warned of: CC109
# broken: no deadlock, every wait ends, no starvation
# undecided: nothing
