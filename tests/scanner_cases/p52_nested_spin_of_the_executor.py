"""P52: a nested spin of the own executor."""

import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.cli = self.create_client(Trigger, 'other')
        self.create_timer(1.0, self.ask)

    def ask(self):
        future = self.cli.call_async(Trigger.Request())
        self.executor.spin_until_future_complete(future)


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(A())
    executor.spin()


if __name__ == '__main__':
    main()

# expect:
# unit a: MultiThreadedExecutor x2 spin, main
#   group a_default EXCLUSIVE default
#   timer ask in a_default every 1
#     blocks executor.spin_until_future_complete on executor @17
#     blocks spin for future on other_client @17
#   client other_client in a_default key=other
