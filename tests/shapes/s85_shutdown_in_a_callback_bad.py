"""A callback shuts rclpy down and goes on to use its node; the spin ends with it."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Job(Node):
    def __init__(self):
        super().__init__('job')
        self.publisher = self.create_publisher(String, 'done', 10)
        self.create_timer(0.5, self.work)

    def work(self):
        rclpy.shutdown()  # breaks here
        self.publisher.publish(String())
        print('goes on')


def main():
    rclpy.init()
    rclpy.spin(Job())


if __name__ == '__main__':
    main()
