"""A constructor waits for a service that its next line makes. Mended."""

import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger


class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.client = self.create_client(Trigger, 'calibrate')
        self.create_service(Trigger, 'calibrate', self.on_calibrate)
        while not self.client.wait_for_service(timeout_sec=1.0):
            self.get_logger().info('not there yet')
        self.create_timer(0.3, self.work)

    def on_calibrate(self, request, response):
        return response

    def work(self):
        print('goes on')


def main():
    rclpy.init()
    rclpy.spin(Arm())


if __name__ == '__main__':
    main()
