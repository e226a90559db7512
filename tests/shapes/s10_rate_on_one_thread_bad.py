"""A callback sleeps by a rate on the only thread, which would serve the rate's timer."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.node import Node
from std_msgs.msg import String


class Driver(Node):
    def __init__(self):
        super().__init__('driver')
        self.starts = self.create_publisher(String, 'start', 10)
        self.create_timer(0.5, self.start)
        group = MutuallyExclusiveCallbackGroup()
        self.create_subscription(String, 'start', self.on_start, 10, callback_group=group)
        self.rate = self.create_rate(20)

    def start(self):
        self.starts.publish(String())

    def on_start(self, msg):
        for _ in range(4):
            self.rate.sleep()  # waits here
        print('goes on')


def main():
    rclpy.init()
    rclpy.spin(Driver())


if __name__ == '__main__':
    main()
