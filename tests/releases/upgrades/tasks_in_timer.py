"""A planner hands two steps over to its executor, and thinks that the first one comes first."""

import rclpy
from rclpy.node import Node


class Planner(Node):
    def __init__(self):
        super().__init__('planner')
        self.once = self.create_timer(0.2, self.plan)

    def plan(self):
        self.once.cancel()
        self.executor.create_task(self.load_map)
        # differs: tasks-oldest-first
        self.executor.create_task(self.find_way)

    def load_map(self):
        print('map', flush=True)

    def find_way(self):
        print('way', flush=True)


def main():
    rclpy.init()
    rclpy.spin(Planner())


if __name__ == '__main__':
    main()
