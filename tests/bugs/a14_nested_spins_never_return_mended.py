"""A14: the services send and go on; the answers are logged."""

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
        self.log(self.arm.call_async(request))
        return response

    def on_land(self, request, response):
        self.log(self.climb.call_async(request))
        return response

    def log(self, future):
        future.add_done_callback(lambda done: self.get_logger().info(str(done.result())))


def main():
    rclpy.init()
    rclpy.spin(Pilot())


if __name__ == '__main__':
    main()

# finds: nothing
