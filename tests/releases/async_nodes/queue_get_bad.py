"""A callback blocks on a queue that another one fills."""

import asyncio
import queue

import rclpy
from rclpy.experimental.async_node import AsyncNode


class Robot(AsyncNode):
    def __init__(self, name):
        super().__init__(name)
        self.queue = queue.Queue()
        self.create_timer(0.1, self.ask)
        self.create_timer(0.2, self.tick)

    async def ask(self):
        print('asks', flush=True)
        self.queue.get()
        print('goes on', flush=True)

    async def tick(self):
        self.queue.put(1)

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
