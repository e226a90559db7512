"""What runs on the loop of a node beside its callbacks: the block, tasks, limits of time, locks."""
# live: no, rclpy 10.0.10 has it first

import asyncio

import rclpy
from rclpy.experimental import AsyncNode
from std_msgs.msg import Empty


class A(AsyncNode):
    def __init__(self):
        super().__init__('a')
        self.lock = asyncio.Lock()
        self.seen = asyncio.Event()
        self.create_subscription(Empty, 'text', self.on_text, 10, concurrent=True)

    async def on_text(self, msg):
        async with self.lock:
            await self.get_clock().sleep(0.1)
        self.seen.set()

    async def work(self):
        async with self.lock:
            async with asyncio.timeout(2.0):
                await self.seen.wait()
        await self.seen.wait()


async def main():
    with rclpy.init():
        async with A() as node:
            async with asyncio.TaskGroup() as tasks:
                tasks.create_task(node.work())
            await asyncio.to_thread(print, 'over')


if __name__ == '__main__':
    asyncio.run(main())

# expect:
# unit a: asyncio_loop=AsyncNode x1 async with, main
#   group on_text_group REENTRANT library=asyncio
#   group no_group REENTRANT groupless
#   subscription on_text in on_text_group key=text coroutine
#     blocks await Clock.sleep 0.1 s @20
#     locks lock @19
#   task main in no_group coroutine one_shot
#     blocks await on work through Future @34
#       ended by work @34
#     blocks await on Future through Future#2 @35
#       ended by print @35
#     changes task @34
#   task work in no_group coroutine
#     blocks await asyncio.Event.wait on on_text through seen 2.0 s @26
#       ended by on_text after 1 @21
#     blocks await asyncio.Event.wait on on_text through seen @27
#       ended by on_text after 1 @21
#     locks lock @24
#   activity pool print started by main after 1 @35
