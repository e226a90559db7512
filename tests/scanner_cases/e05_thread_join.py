"""EffectLog: joining a thread; what the thread does is no effect of the callback."""

import threading

import rclpy
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.value = 0
        self.create_timer(1.0, self.tick)

    def tick(self):
        worker = threading.Thread(target=self.work)
        worker.start()
        worker.join()

    def work(self):
        self.value = 1


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 1
#     blocks Thread.join on worker @18
#       ended by work @17
#   activity thread work (A.work) started by tick @17 count=?
#     writes A.value @21
