"""Locks that a function keeps where it raises what one of its callers catches."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

NODE = """
import threading
import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32

class Refused(Exception):
    pass

class Board(Node):
    def __init__(self):
        super().__init__('board')
        self.guard = threading.Lock()
        self.value = 0
        self.create_subscription(Int32, 'value', self.heard, 10)

    def write(self, value):
        {write}

    def heard(self, msg):
        {heard}

rclpy.init()
rclpy.spin(Board())
"""
BARE = """self.guard.acquire()
        if value < 0:
            raise {raised}
        self.value = value
        self.guard.release()"""
CAUGHT = """try:
            self.write(msg.data)
        except {caught}:
            self.get_logger().warn('refused')"""
FINALLY = """self.guard.acquire()
        try:
            if value < 0:
                raise {raised}
            self.value = value
        finally:
            self.guard.release()"""
OWN = """self.guard.acquire()
        try:
            if value < 0:
                raise {raised}
            self.value = value
        except Exception:
            self.value = 0
        self.guard.release()"""
FREED = BARE.replace('            raise', '            self.guard.release()\n            raise')


@pytest.mark.parametrize(
    ('write', 'raised', 'caught', 'lines'),
    [
        (BARE, 'ValueError(value)', 'ValueError', [20]),
        (BARE, 'ValueError(value)', 'Exception', [20]),
        (BARE, 'Refused()', 'Refused', [20]),
        (BARE, 'Refused()', '(OSError, Exception)', [20]),
        # It ends the node.
        (BARE, 'ValueError(value)', 'KeyError', []),
        (FINALLY, 'ValueError(value)', 'ValueError', []),
        (OWN, 'ValueError(value)', 'ValueError', []),
        (FREED, 'ValueError(value)', 'ValueError', []),
    ],
)
def test_a_raise_that_a_caller_catches(
    write: str, raised: str, caught: str, lines: list[int]
) -> None:
    text = NODE.format(write=write.format(raised=raised), heard=CAUGHT.format(caught=caught))
    found = [each for each in scan_text(text).diagnostics if each.slug == 'lock-kept']
    assert [each.place.line for each in found] == lines
    message = 'write raises here and keeps self.guard, taken at line 18: '
    assert all(each.message.startswith(message) for each in found)


def test_a_raise_that_nobody_catches_ends_the_node() -> None:
    text = NODE.format(write=BARE.format(raised='ValueError()'), heard='self.write(msg.data)')
    assert [each.slug for each in scan_text(text).diagnostics] == []
