"""A callback waits for a service that nobody offers, and holds the only thread."""

import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger


class Mapper(Node):
    def __init__(self):
        super().__init__('mapper')
        self.client = self.create_client(Trigger, 'save_map')
        self.create_timer(0.5, self.save)
        self.create_timer(0.1, self.beat)

    def beat(self):
        print('goes on')

    def save(self):
        self.client.wait_for_service()
        self.client.call_async(Trigger.Request())


def main():
    rclpy.init()
    node = Mapper()
    rclpy.spin(node)


if __name__ == '__main__':
    main()
