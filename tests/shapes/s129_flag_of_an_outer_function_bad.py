"""A loop on a flag of the outer function that a callback of the same group sets."""

import time

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from std_msgs.msg import Empty


def main():
    rclpy.init()
    node = rclpy.create_node('closed')
    pub = node.create_publisher(Empty, 'go', 1)
    came = False

    def on_go(msg):
        nonlocal came
        came = True

    def work():
        while not came:  # waits here
            time.sleep(0.05)
        print('goes on')

    node.create_subscription(Empty, 'go', on_go, 1)
    node.create_timer(1.5, lambda: pub.publish(Empty()), MutuallyExclusiveCallbackGroup())
    node.create_timer(0.5, work)
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(node)
    executor.spin()


if __name__ == '__main__':
    main()
