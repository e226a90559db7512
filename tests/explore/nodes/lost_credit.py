"""Two callbacks change a balance, each by what it has read before it reports that."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String


class Battery(Node):
    def __init__(self):
        super().__init__('battery')
        self.charge = 100
        self.create_subscription(
            String, 'load', self.on_load, 1, callback_group=MutuallyExclusiveCallbackGroup()
        )
        self.create_timer(0.13, self.recharge, callback_group=MutuallyExclusiveCallbackGroup())

    def on_load(self, msg):
        before = self.charge
        self.get_logger().debug('load')
        self.charge = before - 2

    def recharge(self):
        before = self.charge
        self.get_logger().debug('recharge')
        self.charge = before + 1


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=3)
    executor.add_node(Battery())
    executor.spin()


if __name__ == '__main__':
    main()
