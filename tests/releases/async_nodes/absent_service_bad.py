"""A callback waits for a service that nobody offers."""

import asyncio

import rclpy
from rclpy.experimental.async_node import AsyncNode
from std_srvs.srv import Trigger


class Robot(AsyncNode):
    def __init__(self, name):
        super().__init__(name)
        self.client = self.create_client(Trigger, 'nowhere')
        self.create_timer(0.1, self.ask)

    async def ask(self):
        print('asks', flush=True)
        await self.client.wait_for_service()
        print('goes on', flush=True)

    async def finished(self):
        await asyncio.sleep(1.5)


async def main():
    rclpy.init()
    async with Robot('robot') as node:
        await node.finished()


asyncio.run(main())

# observed: hangs
# warned of: nothing
# broken: nothing
# undecided: every wait ends, no starvation
