"""Two threads call rclpy.spin, which share one global executor."""

import threading
import time

import rclpy
from rclpy.node import Node


class Left(Node):
    def __init__(self):
        super().__init__('left')
        self.create_timer(0.05, self.turn)

    def turn(self):
        time.sleep(0.02)
        print('goes on')


class Right(Node):
    def __init__(self):
        super().__init__('right')
        self.create_timer(0.05, self.turn)

    def turn(self):
        time.sleep(0.02)


def main():
    rclpy.init()
    threading.Thread(target=rclpy.spin, args=(Right(),), daemon=True).start()
    rclpy.spin(Left())  # breaks here


if __name__ == '__main__':
    main()
