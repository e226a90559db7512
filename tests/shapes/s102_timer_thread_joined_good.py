"""A callback joins a threading.Timer whose function waits for the callback's lock. Mended."""

import threading

import rclpy
from rclpy.node import Node


class Watchdog(Node):
    def __init__(self):
        super().__init__('watchdog')
        self.lock = threading.Lock()
        self.create_timer(0.5, self.feed)

    def feed(self):
        alarm = threading.Timer(0.05, self.bark)
        alarm.daemon = True
        alarm.start()
        alarm.join()
        print('goes on')

    def bark(self):
        with self.lock:
            self.get_logger().debug('late')


def main():
    rclpy.init()
    rclpy.spin(Watchdog())


if __name__ == '__main__':
    main()
