"""Main waits for an answer before anybody spins the node."""

import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger


class Setup(Node):
    def __init__(self):
        super().__init__('setup')
        self.client = self.create_client(Trigger, 'ready')
        self.create_service(Trigger, 'ready', self.on_ready)
        self.create_timer(0.3, self.work)

    def on_ready(self, request, response):
        return response

    def work(self):
        print('goes on')


def main():
    rclpy.init()
    node = Setup()
    node.client.call(Trigger.Request())  # waits here
    rclpy.spin(node)


if __name__ == '__main__':
    main()
