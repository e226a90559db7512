"""A callback waits for a service that its own group would offer later."""

import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger


class Brain(Node):
    def __init__(self):
        super().__init__('brain')
        self.client = self.create_client(Trigger, 'think')
        self.create_timer(0.5, self.think)
        self.create_timer(1.0, self.start)

    def start(self):
        self.service = self.create_service(Trigger, 'think', self.on_think)

    def think(self):
        self.client.wait_for_service()  # waits here
        print('goes on')

    def on_think(self, request, response):
        return response


def main():
    rclpy.init()
    rclpy.spin(Brain())


if __name__ == '__main__':
    main()
