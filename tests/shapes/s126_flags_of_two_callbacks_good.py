"""A loop waits for two flags, and both are set in another group."""

import time

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Empty


class Waiter(Node):
    def __init__(self):
        super().__init__('waiter')
        self.left, self.right = False, False
        other = MutuallyExclusiveCallbackGroup()
        self.left_pub = self.create_publisher(Empty, 'left', 1)
        self.right_pub = self.create_publisher(Empty, 'right', 1)
        self.create_subscription(Empty, 'left', self.on_left, 1, callback_group=other)
        self.create_subscription(Empty, 'right', self.on_right, 1, callback_group=other)
        self.create_timer(0.2, self.send, callback_group=MutuallyExclusiveCallbackGroup())
        self.create_timer(0.5, self.work)

    def send(self):
        self.left_pub.publish(Empty())
        self.right_pub.publish(Empty())

    def on_left(self, msg):
        self.left = True

    def on_right(self, msg):
        self.right = True

    def work(self):
        self.left, self.right = False, False
        while not (self.left and self.right):
            time.sleep(0.05)
        print('goes on')


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(Waiter())
    executor.spin()


if __name__ == '__main__':
    main()
