"""Supplies what is ordered by a topic, once it knows the details."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger


class Supplier(Node):
    def __init__(self):
        super().__init__('supplier')
        self.details = self.create_client(
            Trigger, 'details', callback_group=MutuallyExclusiveCallbackGroup()
        )
        self.details.wait_for_service()
        self.replies = self.create_publisher(String, 'replies', 10)
        self.create_subscription(String, 'orders', self.on_order, 10)

    def on_order(self, message):
        self.details.call(Trigger.Request())
        self.replies.publish(message)


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Supplier())
    executor.spin()


if __name__ == '__main__':
    main()
