"""A callback that the loop runs waits for a coroutine of the same loop. Mended."""

import asyncio
import threading

import rclpy
from rclpy.node import Node


class Bridge(Node):
    def __init__(self, loop):
        super().__init__('bridge')
        self.loop = loop
        self.create_timer(0.3, self.send)

    def send(self):
        sent = asyncio.run_coroutine_threadsafe(self.transmit(), self.loop)
        sent.result()
        print('goes on')

    async def transmit(self):
        await asyncio.sleep(0.01)


def main():
    rclpy.init()
    loop = asyncio.new_event_loop()
    threading.Thread(target=loop.run_forever, daemon=True).start()
    rclpy.spin(Bridge(loop))


if __name__ == '__main__':
    main()
