"""A12: the step of a plugin waits for a service of its host, which spins only between steps."""

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

    def step(self):
        future = self.client.call_async(Trigger.Request())
        rclpy.spin_until_future_complete(self.node, future)


def main():
    rclpy.init()
    host, plugin = Host(), Plugin()
    while rclpy.ok():
        plugin.step()
        rclpy.spin_once(host, timeout_sec=0.01)


if __name__ == '__main__':
    main()

# finds: CC110:24
