"""A callback sleeps: nobody else on one thread, its own group on several."""

import time

import rclpy
from rclpy import executors
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.node import Node


class Sleeper(Node):
    def __init__(self):
        super().__init__('sleeper')
        self.timer = self.create_timer(0.1, self.ask)
        self.create_timer(0.05, self.tick, callback_group=MutuallyExclusiveCallbackGroup())
        self.create_timer(0.05, self.tock)

    def ask(self):
        self.timer.cancel()
        print('asks', flush=True)
        time.sleep(0.4)
        print('goes on', flush=True)

    def tick(self):
        print('other group', flush=True)

    def tock(self):
        print('own group', flush=True)


def main():
    rclpy.init()
    node = Sleeper()
    executor = executors.MultiThreadedExecutor(num_threads=4)
    executor.add_node(node)
    executor.spin()


if __name__ == '__main__':
    main()

# single: ok, meanwhile nobody
# multi: ok, meanwhile other group
