"""Two threads, each with an executor of its own."""

import threading

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node


class Wheel(Node):
    def __init__(self, name):
        super().__init__(name)
        self.turning = self.create_timer(0.2, self.turn)

    def turn(self):
        self.turning.cancel()
        print('turns', flush=True)


def main():
    rclpy.init()
    left, right = SingleThreadedExecutor(), SingleThreadedExecutor()
    left.add_node(Wheel('left'))
    right.add_node(Wheel('right'))
    threading.Thread(target=left.spin, daemon=True).start()
    right.spin()


if __name__ == '__main__':
    main()
