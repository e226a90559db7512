"""EffectLog: threads that share data: one the set-up joins, one behind a branch, and a flag."""

import os
import threading

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.count = 0
        self.state = 'idle'
        loading = threading.Thread(target=self.load)
        loading.start()
        loading.join()
        if os.environ.get('FAST'):
            threading.Thread(target=self.work).start()
        self.create_subscription(String, 'in', self.on_in, 10)

    def load(self):
        self.count += 1

    def work(self):
        while rclpy.ok():
            if self.state == 'asked':
                self.state = 'idle'
            self.count += 1

    def on_in(self, msg):
        self.count = 0
        self.state = 'asked'


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   subscription on_in in a_default key=in
#     writes A.count @33
#     writes A.state @34
#   activity thread load (A.load) ends_first
#     writes A.count update @24
#   activity thread work (A.work) conditional loops
#     reads A.state @28
#     writes A.state rests constant under A.state (flag) @29
#     writes A.count update @30
