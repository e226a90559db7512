"""P8: a node class without executor or spin: none found, not an invented one."""

from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_timer(0.5, self.tick)

    def tick(self):
        pass

# expect:
# unit a: no executor
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 0.5
#   ? executor executor
