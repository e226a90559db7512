"""A callback that asks for the answer of a request as soon as it has sent it."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.node import Node
from std_srvs.srv import Trigger


class Battery(Node):
    def __init__(self):
        super().__init__('battery')
        other, asking = MutuallyExclusiveCallbackGroup(), MutuallyExclusiveCallbackGroup()
        self.create_service(Trigger, 'level', self.on_level, callback_group=other)
        self.client = self.create_client(Trigger, 'level', callback_group=asking)
        self.create_timer(0.2, self.report)

    def on_level(self, request, response):
        response.message = 'full'
        return response

    def report(self):
        answer = self.client.call_async(Trigger.Request())
        print(answer.result().message, flush=True)


def main():
    rclpy.init()
    rclpy.spin(Battery())


if __name__ == '__main__':
    main()
