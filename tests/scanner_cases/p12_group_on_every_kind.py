"""P12: the group keyword of every create call."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.g = MutuallyExclusiveCallbackGroup()
        self.create_subscription(String, 'in', self.on_in, 10, callback_group=self.g)
        self.create_service(Trigger, 'go', self.on_go, callback_group=self.g)
        self.create_client(Trigger, 'other', callback_group=self.g)
        self.create_guard_condition(self.on_guard, callback_group=self.g)
        self.create_timer(0.5, self.tick, callback_group=self.g)

    def on_in(self, msg):
        pass

    def on_go(self, request, response):
        return response

    def on_guard(self):
        pass

    def tick(self):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group g EXCLUSIVE
#   timer tick in g every 0.5
#   subscription on_in in g key=in
#   guard_condition on_guard in g
#   service on_go in g key=go
#   client other_client in g key=other
