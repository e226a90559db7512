"""D6: the service is a plain function."""

import rclpy
from rclpy.experimental import EventsExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Gate(Node):
    def __init__(self):
        super().__init__('gate')
        self.create_service(Trigger, 'open', self.on_open)

    def on_open(self, request, response):
        return response


def main():
    rclpy.init()
    executor = EventsExecutor()
    executor.add_node(Gate())
    executor.spin()


if __name__ == '__main__':
    main()

# rclpy: 7.1.6

# finds: nothing
