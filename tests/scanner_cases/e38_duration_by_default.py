"""EffectLog: how long a callback sleeps is the default of a parameter, and that is said."""

import time

import rclpy
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.pause = self.declare_parameter('pause', 1.5).value
        self.declare_parameter('text', 'long')
        self.declare_parameter('never', -1.0)
        self.create_timer(1.0, self.tick)

    def tick(self):
        time.sleep(self.pause)
        time.sleep(self.pause / 3)
        time.sleep(self.get_parameter('text').value)
        time.sleep(self.get_parameter('never').value)


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 1
#     blocks time.sleep 1.5 s assumed @18
#     blocks time.sleep 0.5 s assumed @19
#     blocks time.sleep ? s @20
#     blocks time.sleep ? s @21
#     reads A.pause @18
#     reads A.pause @19
