"""Asks for a plan before it is spun, and offers ``ready`` before that or behind it."""

import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger


class FirstAsker(Node):
    def __init__(self):
        super().__init__('first_asker')
        self.plan = self.create_client(Trigger, 'plan')
        if self.declare_parameter('offers_first', False).value:
            self.create_service(Trigger, 'ready', self.on_ready)
            self.ask()
        else:
            self.ask()
            self.create_service(Trigger, 'ready', self.on_ready)
        print('goes on', flush=True)

    def ask(self):
        print('asks', flush=True)
        self.plan.wait_for_service()
        future = self.plan.call_async(Trigger.Request())
        rclpy.spin_until_future_complete(self, future)

    def on_ready(self, request, response):
        return response


def main():
    rclpy.init()
    rclpy.spin(FirstAsker())


if __name__ == '__main__':
    main()
