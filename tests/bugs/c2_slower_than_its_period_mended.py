"""C2: a heartbeat misses most beats; a timer beside it takes longer than its period. Mended."""

import time

import rclpy
from rclpy.node import Node


class Detector(Node):
    def __init__(self):
        super().__init__('detector')
        self.last = 0.0
        self.create_timer(0.05, self.beat)
        self.create_timer(0.5, self.detect)

    def beat(self):
        now = time.monotonic()
        if now - self.last < 0.12:
            self.get_logger().info('alive')
        self.last = now

    def detect(self):
        for _ in range(4):
            time.sleep(0.05)


def main():
    rclpy.init()
    rclpy.spin(Detector())


if __name__ == '__main__':
    main()

# finds: nothing
