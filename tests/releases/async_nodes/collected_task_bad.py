"""A task that nobody keeps is collected before it has ended."""

import asyncio
import gc

import rclpy
from rclpy.experimental.async_node import AsyncNode


class Robot(AsyncNode):
    def __init__(self, name):
        super().__init__(name)
        self.create_timer(0.1, self.ask)
        self.create_timer(0.3, self.collect)

    async def work(self):
        await asyncio.get_running_loop().create_future()

    async def ask(self):
        print('asks', flush=True)
        asyncio.create_task(self.work())  # noqa: RUF006

    def collect(self):
        left = [task for task in asyncio.all_tasks() if task.get_coro().__name__ == 'work']
        before = len(left)
        del left
        gc.collect()
        left = [task for task in asyncio.all_tasks() if task.get_coro().__name__ == 'work']
        print('loses' if len(left) < before else 'goes on', flush=True)

    async def finished(self):
        await asyncio.sleep(1.5)


async def main():
    rclpy.init()
    async with Robot('robot') as node:
        await node.finished()


asyncio.run(main())

# observed: loses
# warned of: CC109, CC123
# broken: no deadlock, every wait ends
# undecided: nothing
