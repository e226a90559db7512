"""A callback blocks on what it has itself given to its loop."""

import asyncio

import rclpy
from rclpy.experimental.async_node import AsyncNode


class Robot(AsyncNode):
    def __init__(self, name):
        super().__init__(name)
        self.create_timer(0.1, self.ask)

    async def work(self):
        return 1

    async def ask(self):
        print('asks', flush=True)
        asyncio.run_coroutine_threadsafe(self.work(), asyncio.get_running_loop()).result()
        print('goes on', flush=True)

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
