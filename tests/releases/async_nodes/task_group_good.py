"""A callback awaits two calls in a group of tasks."""

import asyncio

import rclpy
from rclpy.experimental.async_node import AsyncNode
from std_srvs.srv import Trigger


class Robot(AsyncNode):
    def __init__(self, name):
        super().__init__(name)
        self.client = self.create_client(Trigger, 'go')
        self.create_service(Trigger, 'go', self.on_go)
        self.timer = self.create_timer(0.1, self.ask)

    def on_go(self, request, response):
        return response

    async def ask(self):
        self.timer.cancel()
        print('asks', flush=True)
        async with asyncio.TaskGroup() as tasks:
            tasks.create_task(self.client.call(Trigger.Request()))
            tasks.create_task(self.client.call(Trigger.Request()))
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
