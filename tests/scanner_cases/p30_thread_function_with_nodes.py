"""P30: a function that fills and spins an executor, with a list of nodes."""

import threading

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node


class A(Node):
    def __init__(self, name):
        super().__init__(name)
        self.create_timer(0.5, self.tick)

    def tick(self):
        pass


def run(nodes):
    ex = SingleThreadedExecutor()
    for n in nodes:
        ex.add_node(n)
    ex.spin()


def main():
    rclpy.init()
    a, b = A('a'), A('b')
    thread = threading.Thread(target=run, args=([a, b],), daemon=True)
    thread.start()
    thread.join()


if __name__ == '__main__':
    main()

# expect:
# unit a_and_b: ex=SingleThreadedExecutor x1 spin in thread, main
#   nodes a, b
#   group a_default EXCLUSIVE default
#   group b_default EXCLUSIVE default
#   timer a_tick in a_default (A.tick) every 0.5 node=a
#   timer b_tick in b_default (A.tick) every 0.5 node=b
#   activity main main
#     blocks Thread.join on thread @31
#       ended by outside @30
