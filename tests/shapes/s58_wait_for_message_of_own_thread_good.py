"""A callback on one thread waits for a message that a timer of its executor sends. Mended."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from rclpy.wait_for_message import wait_for_message
from std_msgs.msg import String


class Tracker(Node):
    def __init__(self):
        super().__init__('tracker')
        self.publisher = self.create_publisher(String, 'target', 10)
        self.create_timer(0.2, self.publish, callback_group=MutuallyExclusiveCallbackGroup())
        self.create_timer(0.5, self.track)

    def publish(self):
        self.publisher.publish(String())

    def track(self):
        wait_for_message(String, self, 'target')
        print('goes on')


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Tracker())
    executor.spin()


if __name__ == '__main__':
    main()
