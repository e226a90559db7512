"""EffectLog: an event that two callbacks set, one that other code sets, a future, a done-callback."""

import threading

import rclpy
from rclpy.node import Node
from rclpy.task import Future
from std_msgs.msg import String
from std_srvs.srv import Trigger


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.two, self.other = threading.Event(), threading.Event()
        self.answer = threading.Event()
        self.result = Future()
        self.client = self.create_client(Trigger, 'go')
        self.create_timer(1.0, self.wait)
        self.create_subscription(String, 'in', self.on_in, 10)
        self.other.set()

    async def wait(self):
        self.two.wait()
        self.other.wait()
        future = self.client.call_async(Trigger.Request())
        future.add_done_callback(lambda done: self.answer.set())
        self.answer.wait()
        await self.result
        self.two.set()

    def on_in(self, msg):
        self.two.set()
        self.other.set()
        self.result.set_result(msg)


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   group no_group REENTRANT groupless
#   timer wait in a_default every 1 coroutine
#     blocks Event.wait on two @24
#       ended by wait after 4 @30
#       ended by on_in @33
#     blocks Event.wait on other @25
#       ended by time @21
#       ended by on_in @34
#     blocks Event.wait on lambda_set through answer @28
#       ended by lambda_set @27
#     blocks await on on_in through result @29
#       ended by on_in @35
#     changes done_callback @27
#   subscription on_in in a_default key=in
#   client go_client in a_default key=go
#   done_callback lambda_set in no_group (A.wait.<locals>.<lambda>) key=go conditional when=callback
