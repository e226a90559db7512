"""B10: the answer never comes; timer and client share the default group. Mended."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger


class Navigator(Node):
    def __init__(self):
        super().__init__('navigator')
        self.client = self.create_client(
            Trigger, 'map_ready', callback_group=MutuallyExclusiveCallbackGroup()
        )
        self.create_timer(0.5, self.drive)
        self.create_subscription(
            String, 'stop', self.on_stop, 10, callback_group=MutuallyExclusiveCallbackGroup()
        )

    def on_stop(self, msg):
        self.get_logger().info('stop')

    def drive(self):
        self.client.call(Trigger.Request())


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=3)
    executor.add_node(Navigator())
    executor.spin()


if __name__ == '__main__':
    main()

# finds: nothing
