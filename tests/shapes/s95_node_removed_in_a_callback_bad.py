"""A callback takes its node out of the executor, and nobody adds it again."""

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node


class Shy(Node):
    def __init__(self):
        super().__init__('shy')
        self.count = 0
        self.create_timer(0.2, self.show)

    def show(self):
        self.count += 1
        print('goes on')
        if self.count > 3:
            self.executor.remove_node(self)  # breaks here


def main():
    rclpy.init()
    executor = SingleThreadedExecutor()
    executor.add_node(Shy())
    executor.spin()


if __name__ == '__main__':
    main()
