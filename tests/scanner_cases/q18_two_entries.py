"""Point 18: two entry points in one file are alternatives."""
# live: no, two entries

import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_timer(0.5, self.tick)

    def tick(self):
        pass


def single():
    rclpy.init()
    rclpy.spin(A())


def multi():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=3)
    executor.add_node(A())
    executor.spin()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, single
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 0.5
# unit a: MultiThreadedExecutor x3 spin, multi
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 0.5
