"""Every thread of the pool sleeps by a rate."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Wheels(Node):
    def __init__(self):
        super().__init__('wheels')
        self.left_rate, self.right_rate = self.create_rate(20), self.create_rate(20)
        self.create_timer(0.3, self.turn_left, callback_group=MutuallyExclusiveCallbackGroup())
        self.create_timer(0.3, self.turn_right, callback_group=MutuallyExclusiveCallbackGroup())

    def turn_left(self):
        while rclpy.ok():
            self.left_rate.sleep()  # waits here
            print('goes on')

    def turn_right(self):
        while rclpy.ok():
            self.right_rate.sleep()  # waits here


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Wheels())
    executor.spin()


if __name__ == '__main__':
    main()
