"""A wait for a service that nobody offers."""

import rclpy
from rclpy import executors
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.node import Node
from std_srvs.srv import Trigger


class Caller(Node):
    def __init__(self):
        super().__init__('caller')
        self.client = self.create_client(Trigger, 'answer')
        self.timer = self.create_timer(0.1, self.ask)
        self.create_timer(0.05, self.tick, callback_group=MutuallyExclusiveCallbackGroup())

    def ask(self):
        self.timer.cancel()
        print('asks', flush=True)
        self.client.wait_for_service()
        print('goes on', flush=True)

    def tick(self):
        print('other group', flush=True)


def main():
    rclpy.init()
    node = Caller()
    executor = executors.MultiThreadedExecutor(num_threads=4)
    executor.add_node(node)
    executor.spin()


if __name__ == '__main__':
    main()

# single: blocks, meanwhile nobody
# multi: blocks, meanwhile other group
