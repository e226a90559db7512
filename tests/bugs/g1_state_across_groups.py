"""G1: two groups change a state that nothing guards."""

import threading

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Float64


class Route(Node):
    def __init__(self):
        super().__init__('route')
        self.lock = threading.Lock()
        self.limit = 0.0
        self.create_subscription(
            Float64, 'limit', self.on_limit, 10, callback_group=MutuallyExclusiveCallbackGroup()
        )
        self.create_timer(0.1, self.plan, callback_group=MutuallyExclusiveCallbackGroup())

    def on_limit(self, msg):
        self.limit = msg.data

    def plan(self):
        if self.limit > 1.0:
            self.limit = self.limit - 0.1


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Route())
    executor.spin()


if __name__ == '__main__':
    main()

# finds: CC301:27 note
