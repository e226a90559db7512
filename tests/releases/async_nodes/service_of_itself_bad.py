"""A service awaits the answer of itself."""

import asyncio

import rclpy
from rclpy.experimental.async_node import AsyncNode
from std_srvs.srv import Trigger


class Robot(AsyncNode):
    def __init__(self, name):
        super().__init__(name)
        self.client = self.create_client(Trigger, 'go')
        self.create_service(Trigger, 'go', self.on_go)
        self.create_timer(0.1, self.ask)

    async def on_go(self, request, response):
        print('asks', flush=True)
        await self.client.call(Trigger.Request())
        print('goes on', flush=True)
        return response

    async def ask(self):
        await self.client.call(Trigger.Request())

    async def finished(self):
        await asyncio.sleep(1.5)


async def main():
    rclpy.init()
    async with Robot('robot') as node:
        await node.finished()


asyncio.run(main())

# observed: hangs
# warned of: CC104
# broken: no deadlock, every wait ends, no starvation
# undecided: nothing
