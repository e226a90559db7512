"""A node whose constructor waits for another one before it offers its own service."""

import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger


class Bringup(Node):
    def __init__(self):
        super().__init__('bringup')
        print('asks', flush=True)
        self.other = self.create_client(Trigger, 'needed')
        if self.declare_parameter('patient', True).value:
            while not self.other.wait_for_service(timeout_sec=0.5):
                self.get_logger().info('needed is not there')
        else:
            for _ in range(3):
                if self.other.wait_for_service(timeout_sec=0.5):
                    break
        self.create_service(Trigger, 'offered', self.on_offered)
        self.create_timer(0.2, self.tick)

    def tick(self):
        print('goes on', flush=True)

    def on_offered(self, request, response):
        return response


def main():
    rclpy.init()
    rclpy.spin(Bringup())


if __name__ == '__main__':
    main()
