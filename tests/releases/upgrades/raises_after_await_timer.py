"""A timer awaits a service and then trips over its answer."""

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.node import Node
from std_srvs.srv import Trigger


class Gripper(Node):
    def __init__(self):
        super().__init__('gripper')
        group = ReentrantCallbackGroup()
        self.create_service(Trigger, 'force', self.on_force, callback_group=group)
        self.client = self.create_client(Trigger, 'force', callback_group=group)
        self.create_timer(0.3, self.close, callback_group=group)

    def on_force(self, request, response):
        response.message = 'strong'
        return response

    # differs: exception-after-await-lost
    async def close(self):
        if not self.client.service_is_ready():
            return
        print('asking', flush=True)
        answer = await self.client.call_async(Trigger.Request())
        print(float(answer.message), flush=True)


def main():
    rclpy.init()
    rclpy.spin(Gripper())


if __name__ == '__main__':
    main()
