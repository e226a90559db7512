"""P26: a loop over a generator: what it surely yields, and what it yields perhaps or often."""

import os

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.more = os.environ.get('MORE', 'x').split()
        for topic in self.topics():
            self.create_subscription(String, topic, self.on_msg, 10)

    def topics(self):
        yield from ('one', 'two')
        yield 'three'
        if self.more == ['x']:
            yield 'four'
        for name in self.more:
            yield name

    def on_msg(self, msg):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   subscription one_on_msg in a_default (A.on_msg) key=one
#   subscription two_on_msg in a_default (A.on_msg) key=two
#   subscription three_on_msg in a_default (A.on_msg) key=three
#   subscription four_on_msg in a_default (A.on_msg) key=four count=?
#   subscription on_msg in a_default key=? count=?
#   ? four_on_msg count
#   ? on_msg topic
#   ? on_msg count
