"""D1: a coroutine awaits within its exclusive group, which stays closed. Mended."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.node import Node
from std_srvs.srv import Trigger


class Gate(Node):
    def __init__(self):
        super().__init__('gate')
        self.client = self.create_client(
            Trigger, 'lock', callback_group=MutuallyExclusiveCallbackGroup()
        )
        self.create_service(Trigger, 'open', self.on_open)

    async def on_open(self, request, response):
        return await self.client.call_async(request)


def main():
    rclpy.init()
    rclpy.spin(Gate())


if __name__ == '__main__':
    main()

# finds: nothing
