"""Point 15: a mixin creates on self; the entities belong to the node that inherits it."""

import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Beats:
    def set_up_beats(self):
        self.create_timer(1.0, self.beat)

    def beat(self):
        pass


class A(Beats, Node):
    def __init__(self):
        super().__init__('a')
        self.set_up_beats()

def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(A())
    executor.spin()


if __name__ == '__main__':
    main()

# expect:
# unit a: MultiThreadedExecutor x2 spin, main
#   group a_default EXCLUSIVE default
#   timer beat in a_default every 1
