"""P24: time.sleep, directly and through a helper, with its seconds."""

import time

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_timer(0.5, self.tick)
        self.create_subscription(String, 'in', self.on_in, 10)

    def tick(self):
        time.sleep(0.2)

    def on_in(self, msg):
        self.work(msg)

    def work(self, msg):
        time.sleep(1.5)


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 0.5
#     blocks time.sleep 0.2 s @17
#   subscription on_in in a_default key=in
#     blocks time.sleep 1.5 s @20>23
