"""A call that is not awaited sends nothing."""

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
        self.asked = 0

    def on_go(self, request, response):
        print('goes on', flush=True)
        return response

    async def ask(self):
        print('asks', flush=True)
        self.client.call(Trigger.Request())
        self.asked += 1
        if self.asked == 5:
            print('loses', flush=True)

    async def finished(self):
        await asyncio.sleep(1.5)


async def main():
    rclpy.init()
    async with Robot('robot') as node:
        await node.finished()


asyncio.run(main())

# observed: loses
# warned of: CC123
# broken: nothing
# undecided: nothing
