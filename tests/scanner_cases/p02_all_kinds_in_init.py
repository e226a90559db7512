"""P2, P3, P4, P5: every kind of entity, made in __init__ of a direct subclass."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.sub = self.create_subscription(String, 'in', self.on_in, 10)
        self.srv = self.create_service(Trigger, 'go', self.on_go)
        self.cli = self.create_client(Trigger, 'other')
        self.guard = self.create_guard_condition(self.on_guard)
        self.timer = self.create_timer(0.5, self.tick)
        self.pub = self.create_publisher(String, 'out', 10)

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
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 0.5
#   subscription on_in in a_default key=in
#   guard_condition on_guard in a_default
#   service on_go in a_default key=go
#   client other_client in a_default key=other
