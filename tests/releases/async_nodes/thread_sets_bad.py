"""A thread sets an event of asyncio, which wakes no loop."""

import asyncio
import threading
import time

import rclpy
from rclpy.experimental.async_node import AsyncNode


class Robot(AsyncNode):
    def __init__(self, name):
        super().__init__(name, start_parameter_services=False)
        self.event = asyncio.Event()
        self.timer = self.create_timer(0.1, self.ask)

    async def ask(self):
        print('asks', flush=True)
        self.timer.cancel()
        threading.Thread(target=self.work, daemon=True).start()
        await self.event.wait()
        print('goes on', flush=True)

    def work(self):
        time.sleep(0.2)
        self.event.set()


async def main():
    rclpy.init()
    await Robot('robot').run()


asyncio.run(main())

# observed: hangs
# warned of: CC119
# broken: no data race
# undecided: nothing
