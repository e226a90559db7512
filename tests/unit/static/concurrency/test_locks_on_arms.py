"""A lock is held behind an expression of several arms only where each of them leaves it held."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.collect import findings_of

PROGRAM = """\
import threading
import rclpy
from rclpy.node import Node
from std_msgs.msg import String

class Gate:
    def __init__(self):
        self.lock = threading.Lock()

    def take(self):
        self.lock.acquire()

class Node_(Node):
    def __init__(self):
        super().__init__('node')
        self.first, self.second = Gate(), Gate()
        self.count = 0
        self.create_subscription(String, 'cmd', self.on_cmd, 10)

    def on_cmd(self, msg):
        TAKES
        self.count += 1
        GIVES

rclpy.init()
rclpy.spin(Node_())
"""


@pytest.mark.parametrize(
    ('takes', 'locks'),
    [
        ('self.first.take() if msg.data else self.first.take()', ('lock',)),
        ('self.first.take() if msg.data else print("not")', ()),
        ('print("not") if msg.data else self.first.take()', ()),
        ('gate = self.first if msg.data else self.second\n        gate.take()', ()),
    ],
)
def test_what_all_arms_take_is_held(takes: str, locks: tuple[str, ...]) -> None:
    text = PROGRAM.replace('TAKES', takes).replace('GIVES', 'self.first.lock.release()')
    units = scan_text(text).units
    (write,) = units[0].callbacks[0].writes
    assert tuple(lock for lock in write.locks if lock == 'lock') == locks
    codes = {each.code for each in findings_of(units, [], [None]) if each.severity != 'note'}
    assert 'CC111' not in codes
