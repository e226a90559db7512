"""EffectLog: an Event.wait with and without time-out, and the callback that sets it."""

import threading

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.done = threading.Event()
        self.create_timer(1.0, self.wait)
        self.create_subscription(String, 'in', self.on_in, 10)

    def wait(self):
        self.done.wait()
        self.done.wait(timeout=2.0)

    def on_in(self, msg):
        self.done.set()


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer wait in a_default every 1
#     blocks Event.wait on on_in through done @18
#       ended by on_in @22
#     blocks Event.wait on on_in through done 2.0 s @19
#       ended by on_in @22
#   subscription on_in in a_default key=in
