from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.node import Node


class Base(Node):
    def __init__(self, name):
        super().__init__(name)
        self.group = MutuallyExclusiveCallbackGroup()
        self.create_timer(0.5, self.tick, callback_group=self.group)

    def tick(self):
        raise NotImplementedError
