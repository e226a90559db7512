"""A web backend awaits the future of a client in its asyncio loop, while a thread spins."""

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
    # differs: future-wakes
    response = await doors.client.call_async(Trigger.Request())
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
