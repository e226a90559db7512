"""A message awaits what an earlier one has done."""

import asyncio

import rclpy
from rclpy.experimental.async_node import AsyncNode
from std_msgs.msg import Empty


class Robot(AsyncNode):
    def __init__(self, name):
        super().__init__(name)
        self.event = asyncio.Event()
        self.pub = self.create_publisher(Empty, 'topic', 10)
        self.create_subscription(Empty, 'topic', self.on_topic, 10)
        self.create_timer(0.1, self.tick)
        self.first = True

    def tick(self):
        self.pub.publish(Empty())

    async def on_topic(self, msg):
        if self.first:
            self.first = False
            self.event.set()
            return
        print('asks', flush=True)
        await self.event.wait()
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
# undecided: no deadlock, every wait ends, no starvation
