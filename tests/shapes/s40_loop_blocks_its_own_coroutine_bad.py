"""A callback that the loop runs waits for a coroutine of the same loop."""

import asyncio

import rclpy
from rclpy.node import Node


class Bridge(Node):
    def __init__(self, loop):
        super().__init__('bridge')
        self.loop = loop
        self.create_timer(0.3, self.send)

    def send(self):
        sent = asyncio.run_coroutine_threadsafe(self.transmit(), self.loop)
        sent.result()  # waits here
        print('goes on')

    async def transmit(self):
        await asyncio.sleep(0.01)


async def serve():
    node = Bridge(asyncio.get_running_loop())
    while rclpy.ok():
        rclpy.spin_once(node, timeout_sec=0)
        await asyncio.sleep(0.01)


def main():
    rclpy.init()
    asyncio.run(serve())


if __name__ == '__main__':
    main()
