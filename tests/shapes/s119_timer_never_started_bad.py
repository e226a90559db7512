"""A callback waits for an event of a timer that is never started."""

import threading

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Launcher(Node):
    def __init__(self):
        super().__init__('launcher')
        self.cleared = threading.Event()
        self.clearing = self.create_timer(
            0.2,
            self.clear,
            callback_group=MutuallyExclusiveCallbackGroup(),
            autostart=False,
        )
        self.create_timer(0.5, self.launch)

    def clear(self):
        self.cleared.set()

    def launch(self):
        self.cleared.clear()
        self.cleared.wait()  # waits here
        print('goes on')


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Launcher())
    executor.spin()


if __name__ == '__main__':
    main()
