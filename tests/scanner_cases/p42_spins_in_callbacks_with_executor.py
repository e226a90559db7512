"""P42, P52: a callback spins its node on the executor that runs it, and on others."""

import rclpy
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.cli = self.create_client(Trigger, 'other')
        self.plain = SingleThreadedExecutor()
        self.pool = MultiThreadedExecutor()
        self.create_timer(1.0, self.stays)
        self.create_timer(2.0, self.moves)
        self.create_timer(3.0, self.moves_to_a_pool)

    def stays(self):
        future = self.cli.call_async(Trigger.Request())
        rclpy.spin_until_future_complete(self, future, executor=self.executor)
        rclpy.spin_once(self, executor=self.executor, timeout_sec=0.5)

    def moves(self):
        rclpy.spin_once(self, executor=self.plain)

    def moves_to_a_pool(self):
        rclpy.spin_once(self, executor=self.pool)


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=3)
    executor.add_node(A())
    executor.spin()


if __name__ == '__main__':
    main()

# expect:
# unit a: MultiThreadedExecutor x3 spin, main
#   group a_default EXCLUSIVE default
#   timer stays in a_default every 1
#     blocks executor.spin_until_future_complete on executor @21
#     blocks spin for future on other_client @21
#     blocks executor.spin_once on executor 0.5 s @22
#   timer moves in a_default every 2
#     blocks rclpy.spin_once on a @25
#     changes SingleThreadedExecutor.add_node @25
#   timer moves_to_a_pool in a_default every 3
#     blocks rclpy.spin_once on a @28
#     changes executor.add_node @28
#   client other_client in a_default key=other
