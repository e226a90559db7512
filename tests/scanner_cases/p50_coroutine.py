"""P50: a coroutine callback that awaits a client."""

import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.cli = self.create_client(Trigger, 'other')
        self.create_service(Trigger, 'go', self.on_go)

    async def on_go(self, request, response):
        answer = await self.cli.call_async(Trigger.Request())
        response.success = answer.success
        return response


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   service on_go in a_default key=go coroutine
#     blocks await on other_client @15
#   client other_client in a_default key=other
