"""EffectLog: the usual loop around wait_for_service, in set-up and in a callback."""
# live: no, waits for a service that nobody offers

import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.cli = self.create_client(Trigger, 'go')
        while not self.cli.wait_for_service(timeout_sec=1.0):
            self.get_logger().info('waiting')
        self.create_timer(1.0, self.tick)

    def tick(self):
        while not self.cli.wait_for_service(timeout_sec=0.5):
            pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 1
#     blocks wait_for_service on go_client @18
#   client go_client in a_default key=go
