"""EffectLog: a loop that waits for a future."""

import time

import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.cli = self.create_client(Trigger, 'go')
        self.create_timer(1.0, self.tick)

    def tick(self):
        future = self.cli.call_async(Trigger.Request())
        while not future.done():
            time.sleep(0.01)


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 1
#     blocks busy wait on go_client @18
#     blocks time.sleep 0.01 s @19
#   client go_client in a_default key=go
