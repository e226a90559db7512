"""A4: an action server takes one goal; its execute callback spins the node."""

import rclpy
from rclpy.action import ActionServer
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger
from test_msgs.action import Fibonacci


class Mover(Node):
    def __init__(self):
        super().__init__('mover')
        self.client = self.create_client(Trigger, 'answer')
        self.server = ActionServer(self, Fibonacci, 'move', self.execute)
        self.create_timer(1.0, self.report)

    def report(self):
        self.get_logger().info('alive')

    def execute(self, goal_handle):
        future = self.client.call_async(Trigger.Request())
        rclpy.spin_until_future_complete(self, future)
        goal_handle.succeed()
        return Fibonacci.Result()


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=3)
    executor.add_node(Mover())
    executor.spin()


if __name__ == '__main__':
    main()

# finds: CC106:23
