"""P52, point 21: a nested spin in a callback is reported."""

import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.cli = self.create_client(Trigger, 'other')
        self.create_timer(1.0, self.ask)

    def ask(self):
        future = self.cli.call_async(Trigger.Request())
        rclpy.spin_until_future_complete(self, future)
        rclpy.spin_once(self, timeout_sec=0.1)


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer ask in a_default every 1
#     blocks rclpy.spin_until_future_complete on a @16
#     blocks spin for future on other_client @16
#     blocks rclpy.spin_once on a 0.1 s @17
#     changes rclpy.spin_until_future_complete @16
#     changes rclpy.spin_once @17
#   client other_client in a_default key=other
