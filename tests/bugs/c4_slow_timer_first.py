"""C4: a slow timer, made first, keeps the fast one of its group from ever running."""

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
        self.create_timer(0.01, self.control, callback_group=group)

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

# finds: CC202:19 warning, CC401:27 warning
