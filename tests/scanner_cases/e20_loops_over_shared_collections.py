"""EffectLog: a loop over a collection that another callback changes; a loop over a copy is none."""

from collections import deque

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Table(Node):
    def __init__(self):
        super().__init__('table')
        self.seen = {}
        self.names = set()
        self.last = deque()
        self.lines = []
        self.create_timer(1.0, self.show)
        self.create_timer(2.0, self.copy)
        self.create_subscription(String, 'in', self.on_msg, 10)

    def show(self):
        for name, msg in self.seen.items():
            print(name, msg)
        print([name for name in self.names])
        for number, msg in enumerate(self.last):
            print(number, msg)
        for line in self.lines:
            print(line)

    def copy(self):
        for name in list(self.seen):
            print(name)
        for name in sorted(self.names):
            print(name)

    def on_msg(self, msg):
        self.seen[msg.data] = msg
        self.names.add(msg.data)
        self.last.append(msg)
        self.lines.append(msg.data)


def main():
    rclpy.init()
    rclpy.spin(Table())

# expect:
# unit table: SingleThreadedExecutor x1 rclpy.spin, main
#   group table_default EXCLUSIVE default
#   timer show in table_default every 1
#     reads Table.seen iterates dict @22
#     reads Table.names iterates set @24
#     reads Table.last iterates deque @25
#     reads Table.lines iterates list @27
#   timer copy in table_default every 2
#     reads Table.seen iterates a copy @31
#     reads Table.names iterates a copy @33
#   subscription on_msg in table_default key=in
#     reads Table.seen @37
#     writes Table.seen update in_place @37
#     writes Table.names update in_place @38
#     writes Table.last update in_place @39
#     writes Table.lines update in_place @40
