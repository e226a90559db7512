"""P55, point 7: **kwargs of a caller nobody sees may carry a group."""
# live: no, nobody makes the node

from rclpy.node import Node


class A(Node):
    def __init__(self, **kwargs):
        super().__init__('a')
        self.create_timer(1.0, self.tick, **kwargs)

    def tick(self):
        pass

# expect:
# unit a: no executor
#   group unresolved_1 EXCLUSIVE UNRESOLVED
#   timer tick in unresolved_1 every 1
#   ? unresolved_1 group
#   ? executor executor
