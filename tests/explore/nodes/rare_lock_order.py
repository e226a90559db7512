"""Two timers take two locks in opposite order, each for the fraction of a millisecond."""

import threading

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.plan_lock, self.state_lock = threading.Lock(), threading.Lock()
        self.plan, self.state = 0, 0
        self.create_timer(0.11, self.step, callback_group=MutuallyExclusiveCallbackGroup())
        self.create_timer(0.17, self.watch, callback_group=MutuallyExclusiveCallbackGroup())

    def step(self):
        with self.plan_lock:
            self.plan += 1
            with self.state_lock:
                self.state += 1

    def watch(self):
        with self.state_lock:
            self.state -= 1
            with self.plan_lock:
                self.plan -= 1


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=3)
    executor.add_node(Arm())
    executor.spin()


if __name__ == '__main__':
    main()
