"""A service that awaits another one raises on a refusal."""

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import SetBool, Trigger


class Dock(Node):
    def __init__(self):
        super().__init__('dock')
        group = ReentrantCallbackGroup()
        self.create_service(SetBool, 'charge', self.on_charge, callback_group=group)
        self.create_service(Trigger, 'dock', self.on_dock, callback_group=group)
        self.charger = self.create_client(SetBool, 'charge', callback_group=group)
        self.docker = self.create_client(Trigger, 'dock', callback_group=group)
        self.create_timer(0.5, self.go, callback_group=group)

    def go(self):
        if self.docker.service_is_ready() and self.charger.service_is_ready():
            print('docking', flush=True)
            self.docker.call_async(Trigger.Request())

    def on_charge(self, request, response):
        response.success = False
        return response

    # differs: exception-after-await-lost
    async def on_dock(self, request, response):
        charging = await self.charger.call_async(SetBool.Request(data=True))
        if not charging.success:
            raise ValueError('no current')
        response.success = True
        return response


def main():
    rclpy.init()
    executor = SingleThreadedExecutor()
    executor.add_node(Dock())
    executor.spin()


if __name__ == '__main__':
    main()
