"""The callback of a guard condition waits for an event of its own group. Mended."""

import threading

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Trigger(Node):
    def __init__(self):
        super().__init__('trigger')
        self.loaded = threading.Event()
        self.guard = self.create_guard_condition(self.fire)
        self.create_timer(0.4, self.load, callback_group=MutuallyExclusiveCallbackGroup())
        self.create_timer(0.5, self.pull, callback_group=MutuallyExclusiveCallbackGroup())

    def pull(self):
        self.guard.trigger()

    def load(self):
        self.loaded.set()

    def fire(self):
        self.loaded.clear()
        self.loaded.wait()
        print('goes on')


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=3)
    executor.add_node(Trigger())
    executor.spin()


if __name__ == '__main__':
    main()
