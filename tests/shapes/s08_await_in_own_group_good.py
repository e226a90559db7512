"""A coroutine awaits an answer whose client is in its own group. Mended."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.node import Node
from std_srvs.srv import Trigger


class Scout(Node):
    def __init__(self):
        super().__init__('scout')
        self.client = self.create_client(
            Trigger, 'scan', callback_group=MutuallyExclusiveCallbackGroup()
        )
        self.create_service(
            Trigger, 'scan', self.on_scan, callback_group=MutuallyExclusiveCallbackGroup()
        )
        self.create_timer(0.5, self.scan)

    async def scan(self):
        await self.client.call_async(Trigger.Request())
        print('goes on')

    def on_scan(self, request, response):
        return response


def main():
    rclpy.init()
    rclpy.spin(Scout())


if __name__ == '__main__':
    main()
