"""A request waits for what a later one does, and both run concurrently."""

import asyncio

import rclpy
from rclpy.experimental.async_node import AsyncNode
from std_srvs.srv import Trigger


class Robot(AsyncNode):
    def __init__(self, name):
        super().__init__(name)
        self.event = asyncio.Event()
        self.client = self.create_client(Trigger, 'go')
        self.create_service(Trigger, 'go', self.on_go, concurrent=True)
        self.create_timer(0.1, self.first)
        self.create_timer(0.3, self.second)
        self.count = 0

    async def on_go(self, request, response):
        self.count += 1
        if self.count == 1:
            print('asks', flush=True)
            await self.event.wait()
            print('goes on', flush=True)
        else:
            self.event.set()
        return response

    async def first(self):
        await self.client.call(Trigger.Request())

    async def second(self):
        await self.client.call(Trigger.Request())

    async def finished(self):
        await asyncio.sleep(1.5)


async def main():
    rclpy.init()
    async with Robot('robot') as node:
        await node.finished()


asyncio.run(main())

# observed: goes on
# warned of: nothing
# broken: nothing
# undecided: no deadlock, every wait ends, no starvation
