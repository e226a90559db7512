"""Asks for a plan once a quarter of a second; tells its own position in the default group."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Coordinator(Node):
    def __init__(self):
        super().__init__('coordinator')
        self.answers = MutuallyExclusiveCallbackGroup()
        self.planner = self.create_client(Trigger, '/planner/plan', callback_group=self.answers)
        self.create_service(Trigger, '~/position', self.on_position)
        self.create_timer(0.25, self.coordinate)

    def coordinate(self):
        print('asks', flush=True)
        answer = self.planner.call(Trigger.Request())
        print('goes on', answer.success, flush=True)

    def on_position(self, request, response):
        response.message = '1 2 3'
        return response


def main():
    rclpy.init()
    node = Coordinator()
    while not node.planner.wait_for_service(timeout_sec=1.0):
        node.get_logger().info('no planner yet')
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(node)
    executor.spin()


if __name__ == '__main__':
    main()
