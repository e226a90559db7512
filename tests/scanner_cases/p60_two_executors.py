"""P60, point 18: two executors: a node is in the one that added it last."""

import threading

import rclpy
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_timer(0.5, self.tick)

    def tick(self):
        pass


class B(Node):
    def __init__(self):
        super().__init__('b')
        self.create_timer(0.5, self.tick)

    def tick(self):
        pass


def main():
    rclpy.init()
    first = MultiThreadedExecutor(num_threads=2)
    second = SingleThreadedExecutor()
    a, b = A(), B()
    first.add_node(a)
    first.add_node(b)
    second.add_node(b)
    thread = threading.Thread(target=first.spin, daemon=True)
    thread.start()
    second.spin()


if __name__ == '__main__':
    main()

# expect:
# unit a: first=MultiThreadedExecutor x2 spin in thread, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 0.5
# unit b: second=SingleThreadedExecutor x1 spin, main
#   group b_default EXCLUSIVE default
#   timer tick in b_default every 0.5
