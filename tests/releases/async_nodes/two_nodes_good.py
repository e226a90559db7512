"""Two nodes of one loop: one awaits the answer of a service of the other."""

import asyncio

import rclpy
from rclpy.experimental.async_node import AsyncNode
from std_srvs.srv import Trigger


class Robot(AsyncNode):
    def __init__(self, name):
        super().__init__(name)
        self.client = self.create_client(Trigger, 'go')
        self.create_timer(0.1, self.ask)

    async def ask(self):
        print('asks', flush=True)
        await self.client.call(Trigger.Request())
        print('goes on', flush=True)


class Base(AsyncNode):
    def __init__(self, name):
        super().__init__(name)
        self.create_service(Trigger, 'go', self.on_go)

    def on_go(self, request, response):
        return response


async def main():
    rclpy.init()
    async with Robot('robot'), Base('base'):
        await asyncio.sleep(1.5)


asyncio.run(main())

# observed: goes on
# warned of: nothing
# broken: nothing
# undecided: nothing
