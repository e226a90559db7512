"""After a nested spin in its constructor-like set-up a node is spun by `main` as usual."""

import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger


class Localiser(Node):
    def __init__(self):
        super().__init__('localiser')
        self.create_service(Trigger, 'localise', self.on_localise)
        self.client = self.create_client(Trigger, 'localise')
        self.client.wait_for_service()
        future = self.client.call_async(Trigger.Request())
        rclpy.spin_until_future_complete(self, future)
        print('localised', flush=True)
        self.create_timer(0.2, self.tick)

    def on_localise(self, request, response):
        return response

    def tick(self):
        print('tick', flush=True)


def main():
    rclpy.init()
    rclpy.spin(Localiser())


if __name__ == '__main__':
    main()
