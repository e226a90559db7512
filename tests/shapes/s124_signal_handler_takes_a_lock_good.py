"""A handler of a signal takes the lock of the callback that it interrupts. Mended."""

import os
import signal
import threading
import time

import rclpy
from rclpy.node import Node


class Counter(Node):
    def __init__(self):
        super().__init__('counter')
        self.lock = threading.RLock()
        self.count = 0
        self.create_timer(0.1, self.tick)
        signal.signal(signal.SIGUSR1, self.on_signal)

    def tick(self):
        with self.lock:
            self.count += 1
            time.sleep(0.05)
        print('goes on')

    def on_signal(self, number, frame):
        with self.lock:
            self.count = 0


def send():
    while True:
        time.sleep(0.3)
        os.kill(os.getpid(), signal.SIGUSR1)


def main():
    rclpy.init()
    node = Counter()
    threading.Thread(target=send, daemon=True).start()
    rclpy.spin(node)


if __name__ == '__main__':
    main()
