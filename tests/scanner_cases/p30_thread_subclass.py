"""P30: a Thread subclass whose run spins."""

import threading

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_timer(0.5, self.tick)

    def tick(self):
        pass


class Spinner(threading.Thread):
    def __init__(self, node):
        super().__init__(daemon=True)
        self.executor = SingleThreadedExecutor()
        self.executor.add_node(node)

    def run(self):
        self.executor.spin()


def main():
    rclpy.init()
    spinner = Spinner(A())
    spinner.start()
    spinner.join()


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 spin in thread, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 0.5
#   activity main main
#     blocks Thread.join on spinner @33
#       ended by outside @32
