"""P58: client.call reached from a callback, with the chain."""

import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.cli = self.create_client(Trigger, 'other')
        self.create_timer(1.0, self.tick)

    def tick(self):
        self.ask()

    def ask(self):
        self.cli.wait_for_service(timeout_sec=2.0)
        return self.cli.call(Trigger.Request())


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 1
#     blocks wait_for_service on other_client 2.0 s @15>18
#     blocks client.call on other_client @15>19
#   client other_client in a_default key=other
