"""Point 22: aliased imports."""

import rclpy as rp
import rclpy.executors as ex
from rclpy.callback_groups import ReentrantCallbackGroup as Reentrant
from rclpy.node import Node as N


class A(N):
    def __init__(self):
        super().__init__('a')
        self.create_timer(0.5, self.tick, callback_group=Reentrant())

    def tick(self):
        pass


def main():
    rp.init()
    executor = ex.MultiThreadedExecutor(num_threads=2)
    executor.add_node(A())
    executor.spin()


if __name__ == '__main__':
    main()

# expect:
# unit a: MultiThreadedExecutor x2 spin, main
#   group tick_group REENTRANT
#   timer tick in tick_group every 0.5
