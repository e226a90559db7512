"""A call with a time-out that nobody answers; the node looks for `None`."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Lift(Node):
    def __init__(self):
        super().__init__('lift')
        self.client = self.create_client(
            Trigger, 'up', callback_group=MutuallyExclusiveCallbackGroup()
        )
        self.create_timer(0.3, self.go, callback_group=MutuallyExclusiveCallbackGroup())

    def go(self):
        # differs: call-takes-timeout, call-timeout-raises
        answer = self.client.call(Trigger.Request(), timeout_sec=0.5)
        if answer is None:
            print('nobody there', flush=True)


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=3)
    executor.add_node(Lift())
    executor.spin()


if __name__ == '__main__':
    main()
