"""The program blocks the loop on what a callback would set."""

import asyncio
import threading

import rclpy
from rclpy.experimental.async_node import AsyncNode


class Robot(AsyncNode):
    def __init__(self, name):
        super().__init__(name)
        self.event = threading.Event()
        self.create_timer(0.1, self.tick)

    def tick(self):
        self.event.set()


async def main():
    rclpy.init()
    async with Robot('robot') as node:
        print('asks', flush=True)
        node.event.wait()
        print('goes on', flush=True)


asyncio.run(main())

# observed: hangs
# warned of: CC102
# broken: no deadlock, every wait ends, no starvation
# undecided: nothing
