"""P52: another node spun in a callback by an executor that is named: nothing moves."""

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Asker:
    def __init__(self):
        self.executor = SingleThreadedExecutor()
        self.node = Node('asker')
        self.cli = self.node.create_client(Trigger, 'other')

    def ask(self):
        future = self.cli.call_async(Trigger.Request())
        rclpy.spin_until_future_complete(self.node, future, executor=self.executor)


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.asker = Asker()
        self.own = SingleThreadedExecutor()
        self.create_timer(1.0, self.tick)

    def tick(self):
        self.asker.ask()
        rclpy.spin_once(self, executor=self.own)


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 1
#     blocks executor.spin_until_future_complete on ? @28>17
#       ended by time @17
#     blocks spin for future on ? @28>17
#       ended by outside @17
#     blocks rclpy.spin_once on a @29
#     reads A.asker @28
#     changes SingleThreadedExecutor.add_node @29
# unit asker: no executor, main
#   group asker_default EXCLUSIVE default
#   client other_client in asker_default key=other
#   ? executor executor
