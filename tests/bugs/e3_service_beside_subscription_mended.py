"""E3: the same with more threads than are needed at once."""

import time

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger


class Talker(Node):
    def __init__(self):
        super().__init__('talker')
        self.create_subscription(
            String, 'chatter', self.on_chatter, 10, callback_group=MutuallyExclusiveCallbackGroup()
        )
        self.create_service(
            Trigger, 'rest', self.on_rest, callback_group=MutuallyExclusiveCallbackGroup()
        )

    def on_chatter(self, msg):
        self.get_logger().info(msg.data)

    def on_rest(self, request, response):
        time.sleep(5.0)
        return response


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=3)
    executor.add_node(Talker())
    executor.spin()


if __name__ == '__main__':
    main()

# finds: nothing
