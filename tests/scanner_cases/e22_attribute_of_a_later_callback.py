"""E22: a callback uses what a callback that stands after it makes."""

import threading

import rclpy
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_subscription(String, 'go', self.on_go, 10)
        self.first = self.create_timer(5.0, self.start)

    def on_go(self, msg):
        self.cli.call(Trigger.Request())
        with self.lock:
            self.never.ask()

    def start(self):
        self.first.cancel()
        try:
            self.lock = threading.Lock()
            self.cli = self.create_client(Trigger, 'other')
        except RuntimeError:
            self.get_logger().error('no client')


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer start in a_default every 5 one_shot
#     writes A.lock @25
#     writes A.cli @26
#     changes client @26
#   subscription on_go in a_default key=go
#     blocks client.call on other_client @18
#     reads A.cli @18
#     reads A.lock @19
#     locks lock @19
#   client other_client in a_default key=other conditional count=? when=callback
#   ? other_client count
#   ? a entities
