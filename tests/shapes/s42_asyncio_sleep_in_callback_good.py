"""A coroutine callback awaits asyncio.sleep, for which no loop runs. Mended."""

import time

import rclpy
from rclpy.node import Node


class Blinker(Node):
    def __init__(self):
        super().__init__('blinker')
        self.create_timer(0.4, self.blink)

    def blink(self):
        time.sleep(0.1)
        print('goes on')


def main():
    rclpy.init()
    rclpy.spin(Blinker())


if __name__ == '__main__':
    main()
