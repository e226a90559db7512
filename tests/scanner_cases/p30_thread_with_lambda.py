"""P30: a lambda as the target."""

import threading

import rclpy
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_timer(0.5, self.tick)

    def tick(self):
        pass


def main():
    rclpy.init()
    node = A()
    thread = threading.Thread(target=lambda: rclpy.spin(node), daemon=True)
    thread.start()
    thread.join()


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin in thread, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 0.5
#   activity main main
#     blocks Thread.join on thread @23
#       ended by outside @22
