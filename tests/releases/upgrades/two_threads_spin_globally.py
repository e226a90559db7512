"""Two threads call `rclpy.spin`, each for a node: both mean the one global executor."""

import threading
import time

import rclpy
from rclpy.node import Node


class Wheel(Node):
    def __init__(self, name):
        super().__init__(name)
        self.create_timer(0.2, self.turn)

    def turn(self):
        print(self.get_name(), flush=True)


def main():
    rclpy.init()
    left, right = Wheel('left'), Wheel('right')
    threading.Thread(target=rclpy.spin, args=(left,), daemon=True).start()
    time.sleep(0.5)
    # differs: spin-refused-twice
    rclpy.spin(right)


if __name__ == '__main__':
    main()
