"""Point 18: a file that calls its ``main`` without a guard is one program, not two."""
# live: no, importing it spins

import threading

import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String


class Runtime:
    def __init__(self):
        self.executor = None

    def start(self):
        if self.executor is None:
            self.executor = MultiThreadedExecutor(num_threads=4)
            threading.Thread(target=self.executor.spin, daemon=True).start()
        return self.executor


runtime = Runtime()


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_subscription(String, 'x', self.on_x, 10)
        runtime.start().add_node(self)

    def on_x(self, msg):
        pass


def main():
    rclpy.init()
    A()


main()

# expect:
# unit a: MultiThreadedExecutor x4 spin in thread, __main__
#   group a_default EXCLUSIVE default
#   subscription on_x in a_default key=x
#   activity main main
#     reads Runtime.executor @38>30>20
#     changes add_node @38>30
