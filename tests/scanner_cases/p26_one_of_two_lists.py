"""P26: an item that both of two lists may hold is made once in a loop over either."""
# live: no, which list it is depends on the command line

import os
import sys

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Relay(Node):
    def __init__(self):
        super().__init__('relay')
        every = [{'topic': 'a'}]
        if os.environ.get('MORE'):
            every.extend([{'topic': 'b'}])
        chosen = every if '--all' in sys.argv else [e for e in every if e['topic'] in sys.argv]
        for entry in chosen:
            self.create_subscription(String, entry['topic'], self.on_text, 10)

    def on_text(self, msg):
        pass


def main():
    rclpy.init()
    rclpy.spin(Relay())


# expect:
# unit relay: SingleThreadedExecutor x1 rclpy.spin, main
#   group relay_default EXCLUSIVE default
#   subscription a_on_text in relay_default (Relay.on_text) key=a count=?
#   subscription b_on_text in relay_default (Relay.on_text) key=b conditional count=?
#   ? a_on_text count
#   ? b_on_text count
