"""EffectLog: a function that gives a lock back and takes it again keeps what its caller holds."""

import threading
import time

import rclpy
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.lock = threading.Lock()
        self.create_timer(1.0, self.tick)
        self.create_timer(1.0, self.tock)

    def tick(self):
        with self.lock:
            self.pause()

    def pause(self):
        self.lock.release()
        time.sleep(0.1)
        self.lock.acquire()

    def tock(self):
        self.lock.acquire()
        if self.count_publishers('x') == 0:
            return
        self.lock.release()


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 1
#     blocks time.sleep 0.1 s @19>23
#     locks lock @18
#     locks lock @19>24
#   timer tock in a_default every 1
#     locks lock @27
# error lock-kept @29
