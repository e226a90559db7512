"""A service calls another service of its own node, which is in its group. Mended."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Gateway(Node):
    def __init__(self):
        super().__init__('gateway')
        clients = ReentrantCallbackGroup()
        self.create_service(Trigger, 'open', self.on_open)
        self.create_service(
            Trigger, 'unlock', self.on_unlock, callback_group=MutuallyExclusiveCallbackGroup()
        )
        self.unlock = self.create_client(Trigger, 'unlock', callback_group=clients)
        self.open = self.create_client(Trigger, 'open', callback_group=clients)
        self.create_timer(0.5, self.ask, callback_group=clients)

    def ask(self):
        self.open.call_async(Trigger.Request())

    def on_open(self, request, response):
        response = self.unlock.call(Trigger.Request())
        print('goes on')
        return response

    def on_unlock(self, request, response):
        response.success = True
        return response


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(Gateway())
    executor.spin()


if __name__ == '__main__':
    main()
