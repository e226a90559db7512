"""A coroutine reads, awaits and writes back what another callback wrote meanwhile. Mended."""

import time

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.node import Node
from std_srvs.srv import Trigger


class Counter(Node):
    def __init__(self):
        super().__init__('counter')
        group = ReentrantCallbackGroup()
        self.client = self.create_client(Trigger, 'weigh', callback_group=group)
        self.create_service(Trigger, 'weigh', self.on_weigh, callback_group=group)
        self.total = self.done = 0
        self.create_timer(0.05, self.count, callback_group=group)
        self.create_timer(0.5, self.report, callback_group=MutuallyExclusiveCallbackGroup())

    async def count(self):
        await self.client.call_async(Trigger.Request())
        self.total += 1
        self.done += 1

    def on_weigh(self, request, response):
        time.sleep(0.2)
        return response

    def report(self):
        assert self.total == self.done
        print('goes on')


def main():
    rclpy.init()
    rclpy.spin(Counter())


if __name__ == '__main__':
    main()
