"""EffectLog: a loop that waits for a future and gives its thread back meanwhile."""

import time

import rclpy
from rclpy.node import Node
from rclpy.task import Future
from std_srvs.srv import Trigger


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.cli = self.create_client(Trigger, 'go')
        self.create_timer(1.0, self.tick)
        self.create_timer(1.0, self.tock)

    async def pause(self):
        woken = Future()
        timer = self.create_timer(0.1, lambda: woken.set_result(None))
        await woken
        timer.cancel()

    async def tick(self):
        future = self.cli.call_async(Trigger.Request())
        while not future.done():
            if self.count_publishers('stop'):
                return
            await self.pause()

    async def tock(self):
        future = self.cli.call_async(Trigger.Request())
        while not future.done():
            if self.count_publishers('stop'):
                await self.pause()
            time.sleep(0.01)


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 1 coroutine
#     blocks await on go_client @26
#     blocks await on lambda_set_result through woken conditional @29>21
#       ended by lambda_set_result @20
#     changes timer @29>20
#   timer tock in a_default every 1 coroutine
#     blocks busy wait on go_client @33
#     blocks await on lambda_set_result through woken#2 conditional @35>21
#       ended by lambda_set_result @20
#     blocks time.sleep 0.01 s @36
#     changes timer @35>20
#   timer lambda_set_result in a_default (A.pause.<locals>.<lambda>) every 0.1 conditional count=? when=callback
#   client go_client in a_default key=go
#   ? lambda_set_result count
