"""B14: waits for an event that a callback of the same group sets, in a helper. Mended."""

import threading

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger


class Gripper(Node):
    def __init__(self):
        super().__init__('gripper')
        self.closed = threading.Event()
        self.create_service(Trigger, 'close', self.on_close)
        self.create_subscription(
            String, 'closed', self.on_closed, 10, callback_group=MutuallyExclusiveCallbackGroup()
        )

    def on_close(self, request, response):
        self.wait_until_closed()
        return response

    def wait_until_closed(self):
        self.closed.wait()

    def on_closed(self, msg):
        self.closed.set()


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Gripper())
    executor.spin()


if __name__ == '__main__':
    main()

# finds: nothing
