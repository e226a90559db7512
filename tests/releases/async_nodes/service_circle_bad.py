"""Two services await the answers of each other."""

import asyncio

import rclpy
from rclpy.experimental.async_node import AsyncNode
from std_srvs.srv import Trigger


class Robot(AsyncNode):
    def __init__(self, name):
        super().__init__(name)
        self.left = self.create_client(Trigger, 'left')
        self.right = self.create_client(Trigger, 'right')
        self.create_service(Trigger, 'left', self.on_left)
        self.create_service(Trigger, 'right', self.on_right)
        self.create_timer(0.1, self.ask)

    async def on_left(self, request, response):
        print('asks', flush=True)
        await self.right.call(Trigger.Request())
        print('goes on', flush=True)
        return response

    async def on_right(self, request, response):
        await self.left.call(Trigger.Request())
        return response

    async def ask(self):
        await self.left.call(Trigger.Request())

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
