"""One link of a chain: what is above it asks, and it asks what is below."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import SetBool


class Link(Node):
    def __init__(self):
        super().__init__('link')
        self.below = self.create_client(
            SetBool, 'below/set', callback_group=MutuallyExclusiveCallbackGroup()
        )
        self.create_service(SetBool, 'set', self.on_set)
        self.declare_parameter('period', 0.0)
        period = self.get_parameter('period').value
        if period > 0.0:
            self.create_timer(period, self.tick)

    def tick(self):
        print('asks', flush=True)
        self.below.call(SetBool.Request(data=True))
        print('goes on', flush=True)

    def on_set(self, request, response):
        self.below.call(request)
        response.success = True
        return response


def main():
    rclpy.init()
    node = Link()
    node.below.wait_for_service()
    executor = MultiThreadedExecutor(num_threads=3)
    executor.add_node(node)
    executor.spin()


if __name__ == '__main__':
    main()
