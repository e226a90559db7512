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
# unit a: unknown executor, main
#   group asyncio REENTRANT library=asyncio
#   timer tick in asyncio every 0.1 coroutine
#   service on_a in asyncio key=a coroutine
#     blocks await on b_client @19
#   client b_client in asyncio key=b
#   ? asyncio_loop executor
#   ? asyncio_loop executor
