"""A callback sleeps three times on a rate of its node, on a pool of one worker."""

import rclpy
from rclpy import executors
from rclpy.node import Node


class Driver(Node):
    def __init__(self):
        super().__init__('driver')
        self.rate = self.create_rate(20)
        self.timer = self.create_timer(0.1, self.ask)

    def ask(self):
        self.timer.cancel()
        print('asks', flush=True)
        for _ in range(3):
            self.rate.sleep()
        print('goes on', flush=True)


def main():
    rclpy.init()
    node = Driver()
    executor = executors.MultiThreadedExecutor(num_threads=1)
    executor.add_node(node)
    executor.spin()


if __name__ == '__main__':
    main()

# multi: blocks
