"""B8: the events executor hangs on a service that calls a service. Mended."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
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
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Relay())
    executor.spin()


if __name__ == '__main__':
    main()

# finds: nothing
