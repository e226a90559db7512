"""P30: an executor spun by a thread."""

import threading

import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_timer(0.5, self.tick)

    def tick(self):
        pass


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(A())
    thread = threading.Thread(target=executor.spin, daemon=True)
    thread.start()
    thread.join()


if __name__ == '__main__':
    main()

# expect:
# unit a: MultiThreadedExecutor x2 spin in thread, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 0.5
#   activity main main
#     blocks Thread.join on thread @25
#       ended by outside @24
