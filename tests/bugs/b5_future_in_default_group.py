"""B5: a service waits for the future of a client in its default group."""

import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Parameters(Node):
    def __init__(self):
        super().__init__('parameters')
        self.client = self.create_client(Trigger, 'get')
        self.create_service(Trigger, 'pull', self.on_pull)

    def on_pull(self, request, response):
        future = self.client.call_async(request)
        while not future.done():
            pass
        return future.result()


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=3)
    executor.add_node(Parameters())
    executor.spin()


if __name__ == '__main__':
    main()

# finds: CC101:17, CC401:24 warning
