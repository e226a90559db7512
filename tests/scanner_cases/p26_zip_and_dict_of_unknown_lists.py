"""P26: what is paired with items of unknown number is one entity of unknown count, not two."""

import os

import rclpy
from rclpy.node import Node
from std_msgs.msg import String

TOPICS = ('odom', 'scan')


class Fleet(Node):
    def __init__(self):
        super().__init__('fleet')
        names = os.environ.get('NAMES', 'x').split()
        robots = []
        for name in names:
            if name:
                robots.append((name, 5))
        for (name, depth), topic in zip(robots, TOPICS):
            self.create_subscription(String, name, self.on_zipped, depth)
        for topic, number in zip(TOPICS, range(10)):
            self.create_subscription(String, topic, self.on_known, number)
        for topic, name in zip(TOPICS, names):
            self.create_subscription(String, topic, self.on_first, 10)
        for name, depth in sorted(dict(robots).items()):
            self.create_subscription(String, name, self.on_sorted, depth)
        for name, depth in dict([(name, 3) for name in names]).items():
            self.create_subscription(String, name, self.on_pair, depth)
        topics = ['arm'] if names else ['arm', 'hand']
        for topic in topics:
            self.create_subscription(String, topic, self.on_part, 10)

    def on_zipped(self, msg):
        pass

    def on_known(self, msg):
        pass

    def on_first(self, msg):
        pass

    def on_sorted(self, msg):
        pass

    def on_pair(self, msg):
        pass

    def on_part(self, msg):
        pass


def main():
    rclpy.init()
    rclpy.spin(Fleet())

# expect:
# unit fleet: SingleThreadedExecutor x1 rclpy.spin, main
#   group fleet_default EXCLUSIVE default
#   subscription on_zipped in fleet_default key=? count=?
#   subscription odom_on_known in fleet_default (Fleet.on_known) key=odom
#   subscription scan_on_known in fleet_default (Fleet.on_known) key=scan
#   subscription on_first in fleet_default key=? count=?
#   subscription on_sorted in fleet_default key=? count=?
#   subscription on_pair in fleet_default key=? count=?
#   subscription arm_on_part in fleet_default (Fleet.on_part) key=arm
#   subscription hand_on_part in fleet_default (Fleet.on_part) key=hand conditional
#   ? on_zipped topic
#   ? on_zipped count
#   ? on_first topic
#   ? on_first count
#   ? on_sorted topic
#   ? on_sorted count
#   ? on_pair topic
#   ? on_pair count
