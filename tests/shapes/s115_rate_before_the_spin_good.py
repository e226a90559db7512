"""Main sleeps by a rate of a node that nobody spins yet. Mended."""

import threading

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
    spinner = threading.Thread(target=rclpy.spin, args=(node,), daemon=True)
    spinner.start()
    rate = node.create_rate(10)
    for _ in range(5):
        rate.sleep()
    spinner.join()


if __name__ == '__main__':
    main()
