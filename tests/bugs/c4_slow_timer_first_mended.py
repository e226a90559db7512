"""C4: each timer has a group of its own."""

import time

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Base(Node):
    def __init__(self):
        super().__init__('base')
        group = MutuallyExclusiveCallbackGroup()
        self.create_timer(0.5, self.log_state, callback_group=group)
        self.create_timer(0.01, self.control, callback_group=MutuallyExclusiveCallbackGroup())

    def log_state(self):
        time.sleep(0.6)

    def control(self):
        self.get_logger().debug('control')


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Base())
    executor.spin()


if __name__ == '__main__':
    main()

# finds: nothing
