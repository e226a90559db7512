"""Two callbacks take two locks in opposite order."""

import threading
import time

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Mux(Node):
    def __init__(self):
        super().__init__('mux')
        self.plan_lock, self.motor_lock = threading.Lock(), threading.Lock()
        self.create_timer(0.5, self.move, callback_group=MutuallyExclusiveCallbackGroup())
        self.create_timer(0.5, self.stop, callback_group=MutuallyExclusiveCallbackGroup())

    def move(self):
        with self.plan_lock:
            time.sleep(0.05)
            with self.motor_lock:  # waits here
                print('goes on')

    def stop(self):
        with self.motor_lock:
            time.sleep(0.05)
            with self.plan_lock:  # waits here
                print('goes on')


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Mux())
    executor.spin()


if __name__ == '__main__':
    main()
