"""The backend waits for a future of asyncio, which a done-callback of the client completes."""

import asyncio
import threading

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Doors(Node):
    def __init__(self):
        super().__init__('doors')
        self.create_service(Trigger, 'open_door', self.on_open)
        self.client = self.create_client(Trigger, 'open_door')

    def on_open(self, request, response):
        response.success = True
        return response


async def serve(doors):
    while not doors.client.service_is_ready():
        await asyncio.sleep(0.05)
    loop = asyncio.get_running_loop()
    answered = loop.create_future()
    calling = doors.client.call_async(Trigger.Request())
    calling.add_done_callback(
        lambda done: loop.call_soon_threadsafe(answered.set_result, done.result())
    )
    response = await answered
    print('opened', response.success, flush=True)


def main():
    rclpy.init()
    doors = Doors()
    executor = SingleThreadedExecutor()
    executor.add_node(doors)
    threading.Thread(target=executor.spin, daemon=True).start()
    asyncio.run(serve(doors))


if __name__ == '__main__':
    main()
