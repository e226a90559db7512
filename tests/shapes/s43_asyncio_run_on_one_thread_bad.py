"""A callback runs a coroutine that awaits the answer of a client of its only thread."""

import asyncio

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.node import Node
from std_srvs.srv import Trigger


class Lift(Node):
    def __init__(self):
        super().__init__('lift')
        group = ReentrantCallbackGroup()
        self.client = self.create_client(Trigger, 'floor', callback_group=group)
        self.create_service(Trigger, 'floor', self.on_floor, callback_group=group)
        self.create_timer(0.5, self.ride)

    def ride(self):
        asyncio.run(self.ask())  # waits here
        print('goes on')

    async def ask(self):
        future = self.client.call_async(Trigger.Request())
        while not future.done():  # waits here
            await asyncio.sleep(0.01)

    def on_floor(self, request, response):
        return response


def main():
    rclpy.init()
    rclpy.spin(Lift())


if __name__ == '__main__':
    main()
