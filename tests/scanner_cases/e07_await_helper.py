"""EffectLog: an await through a coroutine helper: the chain, not an await of the helper."""

import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.cli = self.create_client(Trigger, 'go')
        self.create_timer(1.0, self.tick)

    async def tick(self):
        await self.ask()

    async def ask(self):
        return await self.cli.call_async(Trigger.Request())


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 1 coroutine
#     blocks await on go_client @15>18
#   client go_client in a_default key=go
