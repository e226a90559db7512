"""P47: two nodes spun in turn share the global executor."""
# live: no, the nodes are in the executor in turn

import rclpy
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
    a, b = A(), B()
    while rclpy.ok():
        rclpy.spin_once(a, timeout_sec=0.1)
        rclpy.spin_once(b, timeout_sec=0.1)


if __name__ == '__main__':
    main()

# expect:
# unit a_and_b: SingleThreadedExecutor x1 rclpy.spin_once, main
#   nodes a, b
#   group a_default EXCLUSIVE default
#   group b_default EXCLUSIVE default
#   timer a_tick in a_default (A.tick) every 0.5 node=a
#   timer b_tick in b_default (B.tick) every 0.5 node=b
