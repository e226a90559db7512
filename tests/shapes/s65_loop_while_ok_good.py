"""A callback works in a loop for as long as the node lives; no other ever runs. Mended."""

import rclpy
from rclpy.node import Node


class Controller(Node):
    def __init__(self):
        super().__init__('controller')
        self.target = 0.0
        self.create_timer(0.3, self.control)
        self.create_timer(0.4, self.plan)

    def control(self):
        self.step()

    def step(self):
        self.target *= 0.9

    def plan(self):
        self.target = 1.0
        print('goes on')


def main():
    rclpy.init()
    rclpy.spin(Controller())


if __name__ == '__main__':
    main()
