"""A callback calls a service and waits, and the client is in the group of the callback. Mended."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Docker(Node):
    def __init__(self):
        super().__init__('docker')
        group = MutuallyExclusiveCallbackGroup()
        self.client = self.create_client(Trigger, 'dock', callback_group=group)
        self.create_timer(0.5, self.dock)

    def dock(self):
        self.client.call(Trigger.Request())
        print('goes on')


class Dock(Node):
    def __init__(self):
        super().__init__('dock')
        self.create_service(Trigger, 'dock', self.on_dock)

    def on_dock(self, request, response):
        response.success = True
        return response


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(Docker())
    executor.add_node(Dock())
    executor.spin()


if __name__ == '__main__':
    main()
