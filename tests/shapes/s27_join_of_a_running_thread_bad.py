"""A callback joins a thread that runs until a callback of the same group stops it."""

import threading
import time

import rclpy
from rclpy.node import Node


class Patrol(Node):
    def __init__(self):
        super().__init__('patrol')
        self.running = True
        self.worker = threading.Thread(target=self.walk, daemon=True)
        self.worker.start()
        self.create_timer(0.5, self.finish)
        self.create_timer(1.0, self.stop)

    def walk(self):
        while self.running:
            time.sleep(0.05)

    def stop(self):
        self.running = False

    def finish(self):
        self.worker.join()  # waits here
        print('goes on')


def main():
    rclpy.init()
    rclpy.spin(Patrol())


if __name__ == '__main__':
    main()
