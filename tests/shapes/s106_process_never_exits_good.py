"""Main ends after the shutdown, but a thread that is no daemon waits forever. Mended."""

import threading

import rclpy
from rclpy.node import Node


class Exporter(Node):
    def __init__(self):
        super().__init__('exporter')
        self.full = threading.Event()
        threading.Thread(target=self.export).start()
        self.create_timer(1.0, self.stop)

    def export(self):
        self.full.wait()

    def stop(self):
        self.full.set()
        raise SystemExit


def main():
    rclpy.init()
    rclpy.spin(Exporter())


if __name__ == '__main__':
    main()
