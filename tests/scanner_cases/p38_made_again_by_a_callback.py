"""P38: what a callback makes is made once, also where the callback is followed again."""
# live: no, the callback needs an order

import rclpy
from rclpy.action import ActionClient
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger
from tf2_msgs.action import LookupTransform


class Errands(Node):
    def __init__(self):
        super().__init__('errands')
        self.order = None
        self.create_subscription(String, 'run', self.on_run, 10)
        self.create_subscription(String, 'order', self.on_order, 10)

    def on_run(self, msg):
        if self.order is None:
            return
        helper = Node('helper')
        helper.create_client(Trigger, 'fetch')
        ActionClient(self, LookupTransform, 'look')

    def on_order(self, msg):
        self.order = msg


def main():
    rclpy.init()
    rclpy.spin(Errands())


if __name__ == '__main__':
    main()

# expect:
# unit errands: SingleThreadedExecutor x1 rclpy.spin, main
#   group errands_default EXCLUSIVE default
#   subscription on_run in errands_default key=run
#     reads Errands.order @20
#     changes client @23
#     changes action_client @24
#   subscription on_order in errands_default key=order
#     writes Errands.order @27
#   action_client look_action_client in errands_default key=look conditional count=? when=callback
#   ? look_action_client count
# unit helper: no executor, main
#   group helper_default EXCLUSIVE default count=?
#   client fetch_client in helper_default key=fetch conditional count=? when=callback
#   ? fetch_client count
#   ? helper_default count
#   ? executor executor
