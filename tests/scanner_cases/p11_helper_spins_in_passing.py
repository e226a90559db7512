"""P11: a helper spins the node it is given once; who serves the node is the caller's affair."""
# live: no, there is no program

import rclpy
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger


class Helper:
    def __init__(self, node):
        self.node = node
        node.create_subscription(String, 'x', self.on_x, 10)

    def on_x(self, msg):
        pass

    def wait(self):
        rclpy.spin_once(self.node, timeout_sec=1.0)


class Asker(Node):
    def __init__(self):
        super().__init__('asker')
        self.cli = self.create_client(Trigger, 'other')
        future = self.cli.call_async(Trigger.Request())
        rclpy.spin_until_future_complete(self, future)


class Holder:
    def __init__(self, own_thread):
        self.node = rclpy.create_node('holder')
        self.node.create_timer(1.0, self.tick)
        if own_thread:
            rclpy.spin(self.node)

    def tick(self):
        pass

# expect:
# unit node: unknown executor
#   group node_default EXCLUSIVE default
#   subscription on_x in node_default key=x node=?
#   ? on_x node
#   ? executor executor
# unit asker: unknown executor
#   group asker_default EXCLUSIVE default
#   client other_client in asker_default key=other
#   ? executor executor
# unit holder: unknown executor
#   group holder_default EXCLUSIVE default
#   timer tick in holder_default every 1
#   ? executor executor
