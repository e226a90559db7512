"""Reads a record of the store again and again."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Reader(Node):
    def __init__(self):
        super().__init__('reader')
        self.store = self.create_client(
            Trigger, 'fetch', callback_group=MutuallyExclusiveCallbackGroup()
        )
        self.store.wait_for_service()
        self.create_timer(0.05, self.read)

    def read(self):
        print('asks', flush=True)
        self.store.call(Trigger.Request())
        print('goes on', flush=True)


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Reader())
    executor.spin()


if __name__ == '__main__':
    main()
