"""Uses a goal that another callback takes away between the test and the use."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String


class Driver(Node):
    def __init__(self):
        super().__init__('driver')
        self.goal = None
        self.create_subscription(
            String, 'goal', self.on_goal, 1, callback_group=MutuallyExclusiveCallbackGroup()
        )
        self.create_timer(0.05, self.drive, callback_group=MutuallyExclusiveCallbackGroup())
        self.create_timer(0.3, self.cancel, callback_group=MutuallyExclusiveCallbackGroup())

    def on_goal(self, msg):
        self.goal = msg

    def cancel(self):
        self.goal = None

    def drive(self):
        if self.goal is not None:
            self.get_logger().debug('drives')
            self.get_logger().debug(self.goal.data)


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=3)
    executor.add_node(Driver())
    executor.spin()


if __name__ == '__main__':
    main()
