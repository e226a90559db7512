"""P21, P54: a partial and a lambda as done-callbacks."""

from functools import partial

import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.client = self.create_client(Trigger, 'go')
        self.client.call_async(Trigger.Request()).add_done_callback(partial(self.on_answer, 1))
        future = self.client.call_async(Trigger.Request())
        future.add_done_callback(lambda future: self.on_other(future))

    def on_answer(self, number, future):
        pass

    def on_other(self, future):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   group no_group REENTRANT groupless
#   client go_client in a_default key=go
#   done_callback on_answer in no_group key=go
#   done_callback lambda_on_other in no_group (A.__init__.<locals>.<lambda>) key=go
