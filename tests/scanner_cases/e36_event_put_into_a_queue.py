"""Code that takes an event out of a queue may set it: what ends the wait is not known."""

import queue
import threading

import rclpy
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.jobs = queue.Queue()
        self.create_timer(1.0, self.ask)

    def ask(self):
        done = threading.Event()
        self.jobs.put(('job', done))
        done.wait()


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer ask in a_default every 1
#     blocks Event.wait on done @19
#       ended by ?
#     writes jobs update in_place @18
