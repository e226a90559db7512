"""A12: each step looks once whether the answer has come."""

import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger


class Host(Node):
    def __init__(self):
        super().__init__('host')
        self.create_service(Trigger, 'send', self.on_send)

    def on_send(self, request, response):
        return response


class Plugin:
    def __init__(self):
        self.node = rclpy.create_node('plugin')
        self.client = self.node.create_client(Trigger, 'send')
        self.future = None

    def step(self):
        if self.future is None or self.future.done():
            self.future = self.client.call_async(Trigger.Request())
        rclpy.spin_once(self.node, timeout_sec=0.01)


def main():
    rclpy.init()
    host, plugin = Host(), Plugin()
    while rclpy.ok():
        plugin.step()
        rclpy.spin_once(host, timeout_sec=0.01)


if __name__ == '__main__':
    main()

# finds: nothing
