"""A call whose time is over leaves the next one its answer."""

import asyncio

import rclpy
from rclpy.experimental.async_node import AsyncNode
from std_srvs.srv import Trigger


class Robot(AsyncNode):
    def __init__(self, name):
        super().__init__(name)
        self.client = self.create_client(Trigger, 'go')
        self.asked = 0
        self.create_service(Trigger, 'go', self.on_go, concurrent=True)
        self.create_timer(0.3, self.ask)

    async def on_go(self, request, response):
        self.asked += 1
        response.message = str(self.asked)
        await asyncio.sleep(0.5 if self.asked == 1 else 0.0)
        return response

    async def ask(self):
        print('asks', flush=True)
        try:
            async with asyncio.timeout(0.2):
                answer = await self.client.call(Trigger.Request())
        except TimeoutError:
            return
        if answer.message == '2':
            print('goes on', flush=True)

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
# undecided: nothing
