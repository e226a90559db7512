"""G4: a service takes a lock and calls a function that takes it again."""

import threading

import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger


class Driver(Node):
    def __init__(self):
        super().__init__('driver')
        self.lock = threading.Lock()
        self.create_service(Trigger, 'switch', self.on_switch)

    def on_switch(self, request, response):
        with self.lock:
            self.stop()
        return response

    def stop(self):
        with self.lock:
            self.get_logger().info('stop')


def main():
    rclpy.init()
    rclpy.spin(Driver())


if __name__ == '__main__':
    main()

# finds: CC111:22
