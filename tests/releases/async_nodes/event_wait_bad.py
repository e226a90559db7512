"""A blocking wait stops the loop that would end it."""

import asyncio
import threading

import rclpy
from rclpy.experimental.async_node import AsyncNode


class Robot(AsyncNode):
    def __init__(self, name):
        super().__init__(name)
        self.event = threading.Event()
        self.create_timer(0.1, self.ask)
        self.create_timer(0.2, self.tick)

    async def ask(self):
        print('asks', flush=True)
        self.event.wait()
        print('goes on', flush=True)

    async def tick(self):
        print('tick', flush=True)
        self.event.set()

    async def finished(self):
        await asyncio.sleep(1.5)


async def main():
    rclpy.init()
    async with Robot('robot') as node:
        await node.finished()


asyncio.run(main())

# observed: hangs
# warned of: CC102
# broken: no deadlock, every wait ends, no starvation
# undecided: nothing
