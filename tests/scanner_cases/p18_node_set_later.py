"""P18: one attribute holds the node, given at once or later; it is one unknown node."""
# live: no, there is no program

from rclpy.node import Node
from std_msgs.msg import String


class Tab:
    def __init__(self, node=None):
        self._node = node

    def before(self):
        self._node.create_subscription(String, 'y', self.on_y, 10)

    def set_node(self, node: Node):
        self._node = node
        node.create_timer(1.0, self.tick)

    def tick(self):
        pass

    def listen(self):
        self._node.create_subscription(String, 'x', self.on_x, 10)

    def on_x(self, msg):
        pass

    def on_y(self, msg):
        pass

# expect:
# unit node: no executor
#   group node_default EXCLUSIVE default
#   timer tick in node_default every 1 node=? conditional when=later
#   subscription on_y in node_default key=y node=? conditional when=later
#   subscription on_x in node_default key=x node=? conditional when=later
#   ? tick node
#   ? on_y node
#   ? on_x node
#   ? executor executor
