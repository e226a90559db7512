"""Sends a goal from a timer and waits for its end; ``permit`` has a group of its own."""

import rclpy
from rclpy.action import ActionClient
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger
from test_msgs.action import Fibonacci


class Boss(Node):
    def __init__(self):
        super().__init__('boss')
        results = MutuallyExclusiveCallbackGroup()
        self.move = ActionClient(self, Fibonacci, 'move', callback_group=results)
        beside = MutuallyExclusiveCallbackGroup()
        self.create_service(Trigger, 'permit', self.on_permit, callback_group=beside)
        self.create_timer(0.2, self.tick)

    def tick(self):
        print('asks', flush=True)
        self.move.send_goal(Fibonacci.Goal())
        print('goes on', flush=True)

    def on_permit(self, request, response):
        return response


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=3)
    node = Boss()
    node.move.wait_for_server()
    executor.add_node(node)
    executor.spin()


if __name__ == '__main__':
    main()
