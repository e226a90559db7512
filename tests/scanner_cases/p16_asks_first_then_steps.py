"""P16: an answer first, then spin_once in a loop: the loop is how it is spun."""

import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.client = self.create_client(Trigger, 'go')
        self.create_timer(0.5, self.tick)

    def tick(self):
        pass


def main():
    rclpy.init()
    node = A()
    rclpy.spin_until_future_complete(node, node.client.call_async(Trigger.Request()))
    while rclpy.ok():
        rclpy.spin_once(node)


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin_once, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 0.5
#   client go_client in a_default key=go
