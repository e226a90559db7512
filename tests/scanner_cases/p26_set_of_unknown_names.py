"""P26: names that could not be followed may be equal, so that a set of them has any size."""
# live: no, how many names differ depends on the environment

import os

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


CLOCK = ['tick', 'tock', 'tick']


class Relay(Node):
    def __init__(self):
        super().__init__('relay')
        for name in {os.environ.get(role) for role in ('LEFT', 'RIGHT', 'BOTH')}:
            self.create_subscription(String, name, self.on_text, 10)
        for name in set(CLOCK):
            self.create_subscription(String, name, self.on_clock, 10)

    def on_text(self, msg):
        pass

    def on_clock(self, msg):
        pass


def main():
    rclpy.init()
    rclpy.spin(Relay())


# expect:
# unit relay: SingleThreadedExecutor x1 rclpy.spin, main
#   group relay_default EXCLUSIVE default
#   subscription on_text in relay_default key=? count=?
#   subscription tick_on_clock in relay_default (Relay.on_clock) key=tick
#   subscription tock_on_clock in relay_default (Relay.on_clock) key=tock
#   ? on_text topic
#   ? on_text count
