"""A14: two services each spin for an answer; neither returns."""

import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger


class Pilot(Node):
    def __init__(self):
        super().__init__('pilot')
        self.arm = self.create_client(Trigger, 'arm')
        self.climb = self.create_client(Trigger, 'climb')
        self.create_service(Trigger, 'take_off', self.on_take_off)
        self.create_service(Trigger, 'land', self.on_land)

    def on_take_off(self, request, response):
        self.wait(self.arm.call_async(request))
        return response

    def on_land(self, request, response):
        self.wait(self.climb.call_async(request))
        return response

    def wait(self, future):
        rclpy.spin_until_future_complete(self, future)


def main():
    rclpy.init()
    rclpy.spin(Pilot())


if __name__ == '__main__':
    main()

# finds: CC101:25, CC106:25 warning
