"""Main waits for an event that a callback sets only after it has waited for main."""

import threading
import time

import rclpy
from rclpy.node import Node


class Handshake(Node):
    def __init__(self):
        super().__init__('handshake')
        self.hello, self.answer = threading.Event(), threading.Event()
        self.create_timer(0.3, self.greet)

    def greet(self):
        self.answer.wait()  # waits here
        self.hello.set()
        print('goes on')


def main():
    rclpy.init()
    node = Handshake()
    threading.Thread(target=rclpy.spin, args=(node,), daemon=True).start()
    node.hello.wait()  # waits here
    node.answer.set()
    while rclpy.ok():
        time.sleep(0.1)


if __name__ == '__main__':
    main()
