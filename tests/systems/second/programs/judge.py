"""Says yes after a look at the other hand."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Judge(Node):
    def __init__(self):
        super().__init__('judge')
        self.look = self.create_client(
            Trigger, 'look', callback_group=MutuallyExclusiveCallbackGroup()
        )
        self.create_service(Trigger, 'judge', self.on_judge)

    def on_judge(self, request, response):
        self.look.call(Trigger.Request())
        response.success = True
        return response


def main():
    rclpy.init()
    node = Judge()
    node.look.wait_for_service()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(node)
    executor.spin()


if __name__ == '__main__':
    main()
