"""A subscription asks a service and then trips over what it said."""

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.node import Node
from std_msgs.msg import Empty
from std_srvs.srv import Trigger


class Weigher(Node):
    def __init__(self):
        super().__init__('weigher')
        group = ReentrantCallbackGroup()
        self.create_service(Trigger, 'weight', self.on_weight, callback_group=group)
        self.client = self.create_client(Trigger, 'weight', callback_group=group)
        self.parts = self.create_publisher(Empty, 'part', 10)
        self.create_subscription(Empty, 'part', self.on_part, 10, callback_group=group)
        self.create_timer(0.5, self.send, callback_group=group)

    def send(self):
        if self.client.service_is_ready():
            self.parts.publish(Empty())

    def on_weight(self, request, response):
        return response

    # differs: exception-after-await-lost
    async def on_part(self, message):
        print('part', flush=True)
        answer = await self.client.call_async(Trigger.Request())
        grams = {}
        print(grams[answer.message], flush=True)


def main():
    rclpy.init()
    rclpy.spin(Weigher())


if __name__ == '__main__':
    main()
