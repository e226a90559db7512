"""A callback destroys its node, and `run` returns."""

import asyncio

import rclpy
from rclpy.experimental.async_node import AsyncNode


class Robot(AsyncNode):
    def __init__(self, name):
        super().__init__(name)
        self.create_timer(0.1, self.ask)

    async def ask(self):
        print('asks', flush=True)
        self.destroy_node()


async def main():
    rclpy.init()
    await Robot('robot').run()
    print('goes on', flush=True)


asyncio.run(main())

# observed: goes on
# warned of: nothing
# broken: nothing
# undecided: nothing
