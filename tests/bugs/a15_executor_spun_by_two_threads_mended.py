"""A15: a thread spins the executor, and the main program steps it. Mended."""

import threading

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node


class Clock(Node):
    def __init__(self):
        super().__init__('clock')
        self.create_timer(0.1, self.tick)

    def tick(self):
        self.get_logger().info('tick')


def main():
    rclpy.init()
    executor = SingleThreadedExecutor()
    executor.add_node(Clock())
    spinner = threading.Thread(target=executor.spin, daemon=True)
    spinner.start()
    spinner.join()


if __name__ == '__main__':
    main()

# finds: nothing
