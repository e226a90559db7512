"""B12: four callers hold all four threads, and nobody takes the answers. Mended."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Arms(Node):
    def __init__(self):
        super().__init__('arms')
        group = MutuallyExclusiveCallbackGroup()
        self.client = self.create_client(Trigger, 'plan', callback_group=group)
        self.create_timer(0.5, self.first, callback_group=MutuallyExclusiveCallbackGroup())
        self.create_timer(0.5, self.second, callback_group=MutuallyExclusiveCallbackGroup())
        self.create_timer(0.5, self.third, callback_group=MutuallyExclusiveCallbackGroup())
        self.create_timer(0.5, self.fourth, callback_group=MutuallyExclusiveCallbackGroup())

    def first(self):
        self.client.call(Trigger.Request())

    def second(self):
        self.client.call(Trigger.Request())

    def third(self):
        self.client.call(Trigger.Request())

    def fourth(self):
        self.client.call(Trigger.Request())


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=5)
    executor.add_node(Arms())
    executor.spin()


if __name__ == '__main__':
    main()

# finds: nothing
