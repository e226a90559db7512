"""A thread waits for an event with a lock that the callback takes which would set it. Mended."""

import threading

import rclpy
from rclpy.node import Node


class Plotter(Node):
    def __init__(self):
        super().__init__('plotter')
        self.lock = threading.Lock()
        self.fresh = threading.Event()
        threading.Thread(target=self.draw, daemon=True).start()
        self.create_timer(0.3, self.on_data)

    def draw(self):
        while rclpy.ok():
            self.fresh.wait()
            with self.lock:
                self.fresh.clear()

    def on_data(self):
        with self.lock:
            self.fresh.set()
        print('goes on')


def main():
    rclpy.init()
    rclpy.spin(Plotter())


if __name__ == '__main__':
    main()
