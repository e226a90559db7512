"""A single task has nobody to be before or behind."""

import rclpy
from rclpy.node import Node


class Planner(Node):
    def __init__(self):
        super().__init__('planner')
        self.once = self.create_timer(0.2, self.plan)

    def plan(self):
        self.once.cancel()
        self.executor.create_task(self.load_map)

    def load_map(self):
        print('map', flush=True)


def main():
    rclpy.init()
    rclpy.spin(Planner())


if __name__ == '__main__':
    main()
