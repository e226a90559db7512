"""A callback runs a loop until a future is done that its own group sets. Mended."""

import asyncio

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Modem(Node):
    def __init__(self):
        super().__init__('modem')
        self.loop = asyncio.new_event_loop()
        self.reply = self.loop.create_future()
        self.create_timer(0.4, self.ask)
        self.create_timer(0.6, self.on_reply, callback_group=MutuallyExclusiveCallbackGroup())

    def ask(self):
        self.reply = self.loop.create_future()
        self.loop.run_until_complete(self.reply)
        print('goes on')

    def on_reply(self):
        self.loop.call_soon_threadsafe(self.finish)

    def finish(self):
        if not self.reply.done():
            self.reply.set_result(True)


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Modem())
    executor.spin()


if __name__ == '__main__':
    main()
