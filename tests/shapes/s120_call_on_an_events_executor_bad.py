"""A callback of an EventsExecutor waits for an answer, on its only thread."""

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.experimental import EventsExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Valet(Node):
    def __init__(self):
        super().__init__('valet')
        group = ReentrantCallbackGroup()
        self.client = self.create_client(Trigger, 'park', callback_group=group)
        self.create_service(Trigger, 'park', self.on_park, callback_group=group)
        self.create_timer(0.5, self.park)

    def park(self):
        self.client.call(Trigger.Request())  # waits here
        print('goes on')

    def on_park(self, request, response):
        return response


def main():
    rclpy.init()
    executor = EventsExecutor()
    node = Valet()
    executor.add_node(node)
    while rclpy.ok():
        executor.spin_once(timeout_sec=0.1)


if __name__ == '__main__':
    main()
