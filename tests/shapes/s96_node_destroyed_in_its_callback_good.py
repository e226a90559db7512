"""A callback destroys its own node, and the spin goes on with nothing to serve. Mended."""

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node


class Once(Node):
    def __init__(self):
        super().__init__('once')
        self.count = 0
        self.create_timer(0.2, self.work)

    def work(self):
        self.count += 1
        print('goes on')
        if self.count == 5:
            self.count = 0


def main():
    rclpy.init()
    executor = SingleThreadedExecutor()
    executor.add_node(Once())
    executor.spin()


if __name__ == '__main__':
    main()
