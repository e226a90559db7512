"""A node that nobody enters or runs."""

import asyncio

import rclpy
from rclpy.experimental.async_node import AsyncNode


class Robot(AsyncNode):
    def __init__(self, name):
        super().__init__(name)
        self.create_timer(0.1, self.tick)

    def tick(self):
        print('goes on', flush=True)


async def main():
    rclpy.init()
    node = Robot('robot')
    print('asks', node.get_name(), flush=True)
    await asyncio.sleep(1.0)


asyncio.run(main())

# observed: hangs
# warned of: CC405
# broken: no starvation, settings have an effect
# undecided: no deadlock, every wait ends, no data race
