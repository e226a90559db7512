"""C1: one of two timers never runs; the group is always taken again by the other."""

import time

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String


class Panel(Node):
    def __init__(self):
        super().__init__('panel')
        self.create_timer(0.2, self.read_camera)
        self.create_timer(0.2, self.report)
        self.create_subscription(
            String, 'stop', self.on_stop, 10, callback_group=MutuallyExclusiveCallbackGroup()
        )

    def on_stop(self, msg):
        self.get_logger().info('stop')

    def read_camera(self):
        time.sleep(0.3)

    def report(self):
        self.get_logger().info('alive')


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Panel())
    executor.spin()


if __name__ == '__main__':
    main()

# finds: CC202:25 warning
