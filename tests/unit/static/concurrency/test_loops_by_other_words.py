"""Loops over ``itertools.count`` and functions that call themselves again wait like ``while``."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """\
import itertools
import socket
import time
import rclpy
from itertools import count, repeat
from rclpy.node import Node
from std_msgs.msg import String


class Reader(Node):
    def __init__(self):
        super().__init__('reader')
        self.text, self.line, self.tries = None, None, 0
        self.create_subscription(String, 'text', self.on_text, 10)
        self.create_timer(1.0, self.tick)

    def on_text(self, msg):
        self.text = msg.data

    def tick(self, times=0):
        {}


rclpy.init()
rclpy.spin(Reader())
"""
ASKS = 'if self.text is not None:\n    break\ntime.sleep(0.1)'
LOOP = 'for turn in {}:\n    ' + ASKS.replace('\n', '\n    ')
AGAIN = 'if self.text is None:\n    time.sleep(0.1)\n    {}'
RETRY = """\
try:
    self.line = socket.create_connection(('host', 80), timeout=1.0)
except OSError:
    time.sleep(0.5)
    {}"""


def loops(does: str) -> list[str]:
    """What the timer waits for in loops."""
    units = scan_text(PROGRAM.format(does.replace('\n', '\n        '))).units
    blocks = [block for unit in units for each in unit.callbacks for block in each.blocking]
    return [str(block.resource or '?') for block in blocks if 'loop' in block.call]


@pytest.mark.parametrize(
    'does',
    [
        LOOP.format('itertools.count()'),
        LOOP.format('count(1, 2)'),
        LOOP.format('repeat(None)'),
        LOOP.format('range(5)'),
        AGAIN.format('return self.tick(times)'),
        AGAIN.format('self.tick(times=times)'),
        AGAIN.format('return self.tick(times)\nprint(self.text)'),
        f'print(times)\n{AGAIN.format("self.tick(times)")}\nelse:\n    print(self.text)',
    ],
)
def test_they_wait_for_what_they_ask(does: str) -> None:
    assert loops(does) == ['Reader.text']


def test_a_handler_that_begins_anew_tries_again() -> None:
    assert loops(RETRY.format('self.tick(times)')) == ['?']


@pytest.mark.parametrize(
    ('does', 'expected'),
    [
        (LOOP.format('count()'), [False]),
        (AGAIN.format('return self.tick(times)'), [True]),
        (RETRY.format('self.tick(times)'), [True]),
    ],
)
def test_calls_inside_calls_end_by_an_error(does: str, expected: list[bool]) -> None:
    units = scan_text(PROGRAM.format(does.replace('\n', '\n        '))).units
    blocks = [block for unit in units for each in unit.callbacks for block in each.blocking]
    assert [block.recursive for block in blocks if 'loop' in block.call] == expected


@pytest.mark.parametrize(
    'does',
    [
        LOOP.format('repeat(None, 5)'),
        'for turn in count():\n    if turn > 5:\n        break\n    time.sleep(0.1)',
        AGAIN.format('self.tick(times + 1)'),
        AGAIN.format('self.tick(times)\nself.text = None'),
        'self.tries += 1\nif self.tries < 5:\n    time.sleep(0.1)\n    self.tick(times)',
        f'times = 1\n{AGAIN.format("self.tick(times)")}',
        RETRY.format('print(times)'),
    ],
)
def test_what_ends_by_itself_or_goes_on_elsewhere_does_not(does: str) -> None:
    assert loops(does) == []
