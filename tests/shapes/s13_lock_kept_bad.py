"""A callback returns early with the lock it has taken."""

import threading

import rclpy
from rclpy.node import Node


class Planner(Node):
    def __init__(self):
        super().__init__('planner')
        self.lock = threading.Lock()
        self.count = 0
        self.create_timer(0.3, self.plan)

    def plan(self):
        self.lock.acquire()  # waits here
        self.count += 1
        if self.count % 3 == 0:
            return  # breaks here
        print('goes on')
        self.lock.release()


def main():
    rclpy.init()
    rclpy.spin(Planner())


if __name__ == '__main__':
    main()
