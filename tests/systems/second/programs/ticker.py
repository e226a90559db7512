"""Works at a pace that its clock gives."""

import rclpy
from rclpy.node import Node


class Ticker(Node):
    def __init__(self):
        super().__init__('ticker')
        print('asks', flush=True)
        self.create_timer(0.2, self.tick)

    def tick(self):
        print('goes on', flush=True)


def main():
    rclpy.init()
    rclpy.spin(Ticker())


if __name__ == '__main__':
    main()
