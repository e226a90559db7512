"""A callback waits for a service that nobody in the program offers."""

import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger


class Mapper(Node):
    def __init__(self):
        super().__init__('mapper')
        self.client = self.create_client(Trigger, 'save_map')
        self.create_timer(0.5, self.save)

    def save(self):
        self.client.wait_for_service()  # waits here
        self.client.call_async(Trigger.Request())
        print('goes on')


def main():
    rclpy.init()
    rclpy.spin(Mapper())


if __name__ == '__main__':
    main()
