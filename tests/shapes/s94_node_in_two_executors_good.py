"""A node is added to a second executor, which takes it over and is never spun. Mended."""

import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Mouse(Node):
    def __init__(self):
        super().__init__('mouse')
        self.create_timer(0.3, self.run)

    def run(self):
        print('goes on')


def main():
    rclpy.init()
    node = Mouse()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(node)
    executor.spin()


if __name__ == '__main__':
    main()
