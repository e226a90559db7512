"""B13: services hang, each with the group that the other needs. Mended."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Arms(Node):
    def __init__(self):
        super().__init__('arms')
        self.right_client = self.create_client(
            Trigger, 'right', callback_group=MutuallyExclusiveCallbackGroup()
        )
        self.create_service(
            Trigger, 'left', self.on_left, callback_group=MutuallyExclusiveCallbackGroup()
        )
        self.create_service(
            Trigger, 'right', self.on_right, callback_group=MutuallyExclusiveCallbackGroup()
        )

    def on_left(self, request, response):
        return self.right_client.call(request)

    def on_right(self, request, response):
        return response


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(Arms())
    executor.spin()


if __name__ == '__main__':
    main()

# finds: nothing
