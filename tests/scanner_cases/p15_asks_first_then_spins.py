"""P15: an answer first, then forever: one unit, the spin that lasts."""

import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.client = self.create_client(Trigger, 'go')
        self.create_timer(0.5, self.tick)

    def ask(self):
        future = self.client.call_async(Trigger.Request())
        rclpy.spin_until_future_complete(self, future)
        return future.result()

    def tick(self):
        pass


def main():
    rclpy.init()
    node = A()
    node.ask()
    executor = MultiThreadedExecutor(num_threads=3)
    executor.add_node(node)
    executor.spin()


if __name__ == '__main__':
    main()

# expect:
# unit a: MultiThreadedExecutor x3 spin, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 0.5
#   client go_client in a_default key=go
