"""B5: the client has a group of its own, and there is a thread for it."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Parameters(Node):
    def __init__(self):
        super().__init__('parameters')
        self.client = self.create_client(
            Trigger, 'get', callback_group=MutuallyExclusiveCallbackGroup()
        )
        self.create_service(Trigger, 'pull', self.on_pull)

    def on_pull(self, request, response):
        future = self.client.call_async(request)
        while not future.done():
            pass
        return future.result()


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Parameters())
    executor.spin()


if __name__ == '__main__':
    main()

# finds: nothing
