"""A callback shuts down its own executor; the spin ends, and with it the program."""

import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Supervisor(Node):
    def __init__(self, executor):
        super().__init__('supervisor')
        self.pool = executor
        self.create_timer(0.5, self.check)

    def check(self):
        self.pool.shutdown()  # breaks here
        print('goes on')


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Supervisor(executor))
    executor.spin()


if __name__ == '__main__':
    main()
