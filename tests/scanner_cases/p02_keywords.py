"""P2: all arguments by keyword, in any order."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger


class A(Node):
    def __init__(self):
        super().__init__(node_name='a')
        self.create_subscription(qos_profile=10, callback=self.on_in, topic='in', msg_type=String)
        self.create_service(callback=self.on_go, srv_name='go', srv_type=Trigger)
        self.create_client(srv_name='other', srv_type=Trigger)
        self.create_timer(callback=self.tick, timer_period_sec=0.25)

    def on_in(self, msg):
        pass

    def on_go(self, request, response):
        return response

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
#   timer tick in a_default every 0.25
#   subscription on_in in a_default key=in
#   service on_go in a_default key=go
#   client other_client in a_default key=other
