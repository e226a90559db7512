"""A callback waits for a concurrent future that its own group sets."""

import concurrent.futures

import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.reached = concurrent.futures.Future()
        self.create_timer(0.5, self.move)
        self.create_timer(0.7, self.on_reached)

    def move(self):
        self.reached.result()  # waits here
        self.reached = concurrent.futures.Future()
        print('goes on')

    def on_reached(self):
        if not self.reached.done():
            self.reached.set_result(True)


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Arm())
    executor.spin()


if __name__ == '__main__':
    main()
