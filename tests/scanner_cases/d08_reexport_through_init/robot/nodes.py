from rclpy.node import Node

from .groups import make_group


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_timer(0.5, self.tick, callback_group=make_group(True))
        self.create_timer(0.7, self.tock, callback_group=make_group(False))

    def tick(self):
        pass

    def tock(self):
        pass
