"""EffectLog: what waits for the end of a context runs in the code that shuts it down."""

import threading

import rclpy
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.done = threading.Event()
        self.context.on_shutdown(self.finish)
        self.create_timer(9.0, self.tick)
        self.create_timer(9.0, self.tock)

    def finish(self):
        self.done.wait()

    def tick(self):
        rclpy.shutdown()

    def tock(self):
        self.done.set()


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 9
#     blocks Event.wait on tock through done @21>18
#       ended by tock @24
#   timer tock in a_default every 9
# note shut-down-in-callback @21
