"""P30: a spin that is handed to the threads of another framework."""
# live: no, the framework is not there

import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from reactor import call_in_thread


class A(Node):
    def __init__(self, name):
        super().__init__(name)
        self.create_timer(1.0, self.tick)

    def tick(self):
        pass


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(2)
    executor.add_node(A('first'))
    call_in_thread(executor.spin)
    call_in_thread(rclpy.spin, A('second'))

# expect:
# unit first: MultiThreadedExecutor x2 spin in thread, main
#   group first_default EXCLUSIVE default
#   timer tick in first_default every 1
# unit second: SingleThreadedExecutor x1 rclpy.spin in thread, main
#   group second_default EXCLUSIVE default
#   timer tick in second_default every 1
#   ? second entities
