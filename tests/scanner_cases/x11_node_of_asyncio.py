"""A node that asyncio runs: no executor, no callback groups, and a client whose call is awaited."""
# live: no, rclpy 10.0.10 has it first

import asyncio

import rclpy
from rclpy.experimental import AsyncNode
from std_srvs.srv import Trigger


class A(AsyncNode):
    def __init__(self):
        super().__init__('a')
        self.client = self.create_client(Trigger, 'b')
        self.create_service(Trigger, 'a', self.on_a)
        self.create_timer(0.1, self.tick, True)

    async def on_a(self, request, response):
        return await self.client.call(request)

    async def tick(self):
        await asyncio.sleep(0.01)


async def main():
    rclpy.init()
    await A().run()


if __name__ == '__main__':
    asyncio.run(main())

# expect:
# unit a: asyncio_loop=AsyncNode x1 AsyncNode.run, main
#   group b_client_group EXCLUSIVE library=asyncio
#   group on_a_group EXCLUSIVE library=asyncio
#   group tick_group EXCLUSIVE library=asyncio
#   timer tick in tick_group every 0.1 coroutine
#     blocks await asyncio.sleep 0.01 s @22
#   service on_a in on_a_group key=a coroutine
#     blocks await on b_client @19
#   client b_client in b_client_group key=b
