"""Main sleeps by a rate of a node that nobody spins yet."""

import rclpy
from rclpy.node import Node


class Starter(Node):
    def __init__(self):
        super().__init__('starter')
        self.create_timer(0.3, self.work)

    def work(self):
        print('goes on')


def main():
    rclpy.init()
    node = Starter()
    rate = node.create_rate(10)
    for _ in range(5):
        rate.sleep()  # waits here
    rclpy.spin(node)


if __name__ == '__main__':
    main()
