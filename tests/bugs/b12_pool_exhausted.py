"""B12: four callers hold all four threads, and nobody takes the answers."""

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Arms(Node):
    def __init__(self):
        super().__init__('arms')
        group = ReentrantCallbackGroup()
        self.client = self.create_client(Trigger, 'plan', callback_group=group)
        self.create_timer(0.5, self.first, callback_group=group)
        self.create_timer(0.5, self.second, callback_group=group)
        self.create_timer(0.5, self.third, callback_group=group)
        self.create_timer(0.5, self.fourth, callback_group=group)

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
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(Arms())
    executor.spin()


if __name__ == '__main__':
    main()

# finds: CC103:21
