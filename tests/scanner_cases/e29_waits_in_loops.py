"""EffectLog: how often a run waits at one place, where the rounds of the loops are known."""

import time

import rclpy
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.steps = [0.1, 0.2]
        self.create_timer(1.0, self.known)
        self.create_timer(1.0, self.left_early)
        self.create_timer(1.0, self.unknown)

    def known(self):
        for _ in range(3):
            time.sleep(0.02)
            for _ in ('left', 'right'):
                self.pause()
        for _ in range(200):
            time.sleep(0.01)
        else:
            time.sleep(0.03)
        self.pause()

    def pause(self):
        time.sleep(0.5)

    def left_early(self):
        for _ in range(3):
            time.sleep(0.02)
            if not rclpy.ok():
                break

    def unknown(self):
        for step in self.steps:
            time.sleep(step)
        while rclpy.ok():
            time.sleep(0.02)


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer known in a_default every 1
#     blocks time.sleep 0.02 s 3 times @19
#     blocks time.sleep 0.5 s 6 times @21>29
#     blocks time.sleep 0.01 s 200 times @23
#     blocks time.sleep 0.03 s @25
#     blocks time.sleep 0.5 s @26>29
#   timer left_early in a_default every 1
#     blocks time.sleep 0.02 s @33
#     blocks time.sleep conditional 0.02 s 2 times @33
#   timer unknown in a_default every 1
#     blocks time.sleep 0.1 s @39
#     blocks time.sleep 0.2 s @39
#     blocks time.sleep 0.02 s @41
#     blocks endless loop on the end of the program @40
#     reads A.steps iterates list @38
