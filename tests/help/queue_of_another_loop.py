"""A callback puts into a queue that a coroutine awaits in the loop of another thread."""

import asyncio
import threading

import rclpy
from rclpy.node import Node


class Bridge(Node):
    def __init__(self, loop):
        super().__init__('bridge')
        self.loop = loop
        self.outbox = asyncio.Queue()
        self.create_timer(0.3, self.on_text)

    def on_text(self):
        self.outbox.put_nowait('text')

    async def send(self):
        while True:
            await self.outbox.get()
            print('goes on')


def main():
    rclpy.init()
    loop = asyncio.new_event_loop()
    node = Bridge(loop)
    threading.Thread(target=loop.run_forever, daemon=True).start()
    asyncio.run_coroutine_threadsafe(node.send(), loop)
    rclpy.spin(node)


if __name__ == '__main__':
    main()
