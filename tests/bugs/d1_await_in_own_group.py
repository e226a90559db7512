"""D1: a coroutine awaits within its exclusive group, which stays closed."""

import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger


class Gate(Node):
    def __init__(self):
        super().__init__('gate')
        self.client = self.create_client(Trigger, 'lock')
        self.create_service(Trigger, 'open', self.on_open)

    async def on_open(self, request, response):
        return await self.client.call_async(request)


def main():
    rclpy.init()
    rclpy.spin(Gate())


if __name__ == '__main__':
    main()

# finds: CC104:15
