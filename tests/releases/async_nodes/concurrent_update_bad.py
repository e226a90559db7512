"""Runs of one callback, which run concurrently, read a number, await, and write it."""

import asyncio

import rclpy
from rclpy.experimental.async_node import AsyncNode
from std_msgs.msg import Empty


class Robot(AsyncNode):
    def __init__(self, name):
        super().__init__(name)
        self.n = 0
        self.runs = 0
        self.pub = self.create_publisher(Empty, 'topic', 10)
        self.create_subscription(Empty, 'topic', self.on_topic, 10, concurrent=True)
        self.create_timer(0.05, self.tick)

    def tick(self):
        self.pub.publish(Empty())

    async def on_topic(self, msg):
        print('asks', flush=True)
        n = self.n
        await asyncio.sleep(0.2)
        self.n = n + 1
        self.runs += 1

    async def finished(self):
        await asyncio.sleep(1.0)
        print('loses' if self.n < self.runs else 'goes on', flush=True)


async def main():
    rclpy.init()
    async with Robot('robot') as node:
        await node.finished()


asyncio.run(main())

# observed: loses
# warned of: CC304
# broken: no data race
# undecided: nothing
