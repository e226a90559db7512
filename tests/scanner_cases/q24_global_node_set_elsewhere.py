"""Point 24: a global node that one function sets and others use; no program."""
# live: no, there is no program

import rclpy
from std_srvs.srv import Trigger

_node = None


def init():
    global _node
    _node = rclpy.create_node('params')


def ask(name):
    client = _node.create_client(Trigger, f'{name}/x')
    rclpy.spin_until_future_complete(_node, client.call_async(Trigger.Request()))


def ask_all():
    ask('one')


class Later:
    def __init__(self):
        self.node = None

    def use(self):
        self.node.create_timer(1.0, print)

# expect:
# unit params: SingleThreadedExecutor x1 rclpy.spin_until_future_complete
#   group params_default EXCLUSIVE default
#   client one_x_client in params_default key=one/x conditional when=later
# unit node: no executor
#   group node_default EXCLUSIVE default
#   timer print in node_default every 1 node=? conditional when=later
#   ? print node
#   ? executor executor
