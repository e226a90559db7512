"""B8: the events executor hangs on a service that calls a service."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.experimental import EventsExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Relay(Node):
    def __init__(self):
        super().__init__('relay')
        self.client = self.create_client(
            Trigger, 'inner', callback_group=MutuallyExclusiveCallbackGroup()
        )
        self.create_service(Trigger, 'outer', self.on_outer)

    def on_outer(self, request, response):
        return self.client.call(request)


def main():
    rclpy.init()
    executor = EventsExecutor()
    executor.add_node(Relay())
    executor.spin()


if __name__ == '__main__':
    main()

# finds: CC102:19, CC402:14 note
