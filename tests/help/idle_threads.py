"""Two groups on eight threads."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.create_timer(0.1, self.control, callback_group=MutuallyExclusiveCallbackGroup())
        self.create_timer(1.0, self.report)

    def control(self):
        print('goes on')

    def report(self):
        self.get_logger().debug('alive')


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=8)
    executor.add_node(Arm())
    executor.spin()


if __name__ == '__main__':
    main()
