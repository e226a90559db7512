"""EffectLog: a callback spins until another one has written a flag; a loop that only sleeps."""

import time

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.arrived = False
        self.create_subscription(String, 'in', self.on_in, 10)
        self.create_timer(1.0, self.tick)

    def on_in(self, msg):
        self.arrived = True

    def tick(self):
        while not self.arrived:
            rclpy.spin_once(self, timeout_sec=0.1)
        while not self.arrived:
            time.sleep(0.1)


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 1
#     blocks busy wait on ? @21
#       ended by ?
#     blocks rclpy.spin_once on a 0.1 s @22
#     blocks time.sleep 0.1 s @24
#     blocks polling loop on on_in through A.arrived @23
#       ended by on_in @18
#     reads A.arrived @21
#     reads A.arrived @23
#     changes rclpy.spin_once @22
#   subscription on_in in a_default key=in
#     writes A.arrived @18
