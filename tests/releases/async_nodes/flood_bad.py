"""A callback that never awaits publishes what makes it run again."""

import asyncio

import rclpy
from rclpy.experimental.async_node import AsyncNode
from std_msgs.msg import Empty


class Robot(AsyncNode):
    def __init__(self, name):
        super().__init__(name)
        self.ticks = 0
        self.runs = 0
        self.pub = self.create_publisher(Empty, 'topic', 10)
        self.create_subscription(Empty, 'topic', self.on_topic, 10)
        self.create_timer(0.1, self.tick)

    def tick(self):
        self.ticks += 1
        self.pub.publish(Empty())

    def on_topic(self, msg):
        if self.runs == 0:
            print('asks', flush=True)
        self.runs += 1
        self.pub.publish(Empty())

    async def finished(self):
        await asyncio.sleep(1.0)
        print(self.runs, self.ticks)
        print('late' if self.ticks < 5 else 'goes on', flush=True)


async def main():
    rclpy.init()
    async with Robot('robot') as node:
        await node.finished()


asyncio.run(main())

# observed: hangs
# warned of: CC207
# broken: no starvation
# undecided: nothing
