"""EffectLog: loops that wait for data which others write, or nobody, or unknown code."""

import time

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.arrived = self.closed = self.never = False
        self.pose = None
        self.left = 3
        self.create_subscription(String, 'in', self.on_in, 10)
        self.create_timer(1.0, self.wait)
        self.create_timer(1.0, self.wait_for_others)
        self.create_timer(1.0, self.work)

    def on_in(self, msg):
        self.arrived = True
        self.pose = msg

    def close(self):
        self.closed = True

    def wait(self):
        while not self.arrived:
            time.sleep(0.1)
        end = time.monotonic() + 1.0
        while self.pose is None and time.monotonic() < end:
            time.sleep(0.1)

    def wait_for_others(self):
        while not self.closed:
            pass
        while True:
            if self.never:
                break
            time.sleep(0.1)
        while self.count_publishers('in') == 0:
            time.sleep(0.1)

    def work(self):
        while self.left > 0:
            self.left -= 1
        while rclpy.ok():
            time.sleep(0.1)


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer wait in a_default every 1
#     blocks time.sleep 0.1 s @30
#     blocks polling loop on on_in through A.arrived @29
#       ended by on_in @22
#     blocks time.sleep 0.1 s @33
#     blocks polling loop on on_in through A.pose ? s @32
#       ended by on_in @23
#     reads A.arrived @29
#     reads A.pose @32
#   timer wait_for_others in a_default every 1
#     blocks polling loop on A.closed @36
#       ended by ?
#     blocks time.sleep 0.1 s @41
#     blocks polling loop on A.never @39
#     blocks time.sleep 0.1 s @43
#     blocks polling loop on ? @42
#       ended by ?
#     reads A.closed @36
#     reads A.never @39
#   timer work in a_default every 1
#     blocks time.sleep 0.1 s @49
#     blocks endless loop on the end of the program @48
#     reads A.left @46
#     writes A.left update @47
#   subscription on_in in a_default key=in
#     writes A.arrived @22
#     writes A.pose @23
