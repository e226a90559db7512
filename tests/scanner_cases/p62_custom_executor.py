"""P62, point 8: a custom executor class is unresolved."""

import rclpy
from rclpy.executors import Executor
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_timer(0.5, self.tick)

    def tick(self):
        pass


class AsyncMultiThreadedExecutor(Executor):
    def _spin_once_impl(self, timeout_sec=None, wait_condition=lambda: False):
        handler, _, _ = self.wait_for_ready_callbacks(timeout_sec, None, wait_condition)
        handler()


def main():
    rclpy.init()
    executor = AsyncMultiThreadedExecutor()
    executor.add_node(A())
    executor.spin()


if __name__ == '__main__':
    main()

# expect:
# unit a: AsyncMultiThreadedExecutor x1 spin UNRESOLVED, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 0.5
#   ? executor executor
