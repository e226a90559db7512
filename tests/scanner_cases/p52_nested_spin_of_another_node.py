"""P52: nodes that only a callback spins; by rclpy and on an executor."""

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Asker(Node):
    def __init__(self, name):
        super().__init__(name)
        self.cli = self.create_client(Trigger, 'other')


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.asker = Asker('asker')
        self.second = Asker('second')
        self.inner = SingleThreadedExecutor()
        self.inner.add_node(self.second)
        self.create_timer(1.0, self.tick)

    def tick(self):
        future = self.asker.cli.call_async(Trigger.Request())
        rclpy.spin_until_future_complete(self.asker, future)
        self.inner.spin_once(timeout_sec=0.1)


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 1
#     blocks rclpy.spin_until_future_complete on ? @26
#     blocks spin for future on ? @26
#     blocks executor.spin_once on ? 0.1 s @27
#       ended by time @27
#     changes rclpy.spin_until_future_complete @26
# unit second: inner=SingleThreadedExecutor x1 not spun UNRESOLVED, main
#   group second_default EXCLUSIVE default
#   client other_client in second_default key=other
#   ? inner executor
# unit asker: no executor, main
#   group asker_default EXCLUSIVE default
#   client other_client in asker_default key=other
#   ? executor executor
