"""The program sleeps in the thread of the loop, and no callback runs."""

import asyncio
import time

import rclpy
from rclpy.experimental.async_node import AsyncNode


class Robot(AsyncNode):
    def __init__(self, name):
        super().__init__(name)
        self.ticks = 0
        self.create_timer(0.1, self.tick)

    def tick(self):
        self.ticks += 1


async def main():
    rclpy.init()
    async with Robot('robot') as node:
        print('asks', flush=True)
        await asyncio.sleep(0.05)
        time.sleep(1.0)
        print('goes on' if node.ticks else 'late', flush=True)


asyncio.run(main())

# observed: late
# warned of: CC201
# broken: no starvation
# undecided: nothing
