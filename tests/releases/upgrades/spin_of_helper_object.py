"""A helper that may be used in `main` and is used in a callback."""

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Caller:
    def __init__(self, node, group):
        self.node = node
        self.client = node.create_client(Trigger, 'reset', callback_group=group)

    def __call__(self):
        future = self.client.call_async(Trigger.Request())
        # differs: spin-refused-twice
        self.node.executor.spin_until_future_complete(future, timeout_sec=1.0)
        return future.done()


class Watchdog(Node):
    def __init__(self):
        super().__init__('watchdog')
        group = ReentrantCallbackGroup()
        self.reset = Caller(self, group)
        self.create_service(Trigger, 'reset', self.on_reset, callback_group=group)
        self.create_timer(0.5, self.check, callback_group=group)

    def on_reset(self, request, response):
        return response

    def check(self):
        print('reset', self.reset(), flush=True)


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=3)
    executor.add_node(Watchdog())
    executor.spin()


if __name__ == '__main__':
    main()
