"""Updates that CPython does in one piece are advice; what others can get into is a race."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.collect import findings_of

PROGRAM = """
import time
from collections import Counter
from fractions import Fraction
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Empty, Int32

STEP = 2

class State:
    seen = 0

class Tally(Node):
    def __init__(self):
        self.state = State()
        super().__init__('tally')
        self.total = 0
        self.text = ''
        self.share = Fraction(0)
        self.kinds = Counter()
        self.counts = {{'red': 0}}
        self.rows = [0, 0]
        self.other = None
        self.create_subscription(Int32, 'x', self.on_x, 10, callback_group={group}CallbackGroup())
        self.create_subscription(Empty, 'y', self.on_y, 10)

    @property
    def view(self):
        return self.state

    def on_x(self, msg):
        {x}

    def on_y(self, msg):
        {y}

rclpy.init()
executor = MultiThreadedExecutor(4)
executor.add_node(Tally())
executor.spin()
"""


def told(x: str, y: str = 'pass', group: str = 'Reentrant') -> list[str]:
    """Code and severity of each race; lines of a callback follow each other."""
    indent = '\n        '
    text = PROGRAM.format(x=x.replace('\n', indent), y=y.replace('\n', indent), group=group)
    units = scan_text(text).units
    found = findings_of(units, [], [None])
    return [f'{f.code} {f.severity.value}' for f in found if f.code.startswith('CC3')]


@pytest.mark.parametrize(
    'update',
    [
        'self.total += 1',
        'self.total -= STEP',
        'self.total = self.total + 2 * STEP',
        'self.total = -self.total',
        "self.text += 'x'",
        "self.counts['red'] += 1",
        'self.rows[1] += 1',
        'step = 3\nself.total += step',
        'print(self.total)\nself.total += 1',
        'began = time.monotonic()\ntook = time.monotonic() - began\nself.total += took',
        'size = len(msg.data)\nself.total += size',
        'self.state.seen += 1',
        'self.total += 1\nself.total += 1',
        # Its test and its write are one piece as well.
        'if self.total < 9:\n    self.total += 1',
    ],
)
def test_an_update_in_one_piece_is_advice(update: str) -> None:
    assert told(update) == ['CC304 note']


@pytest.mark.parametrize(
    'update',
    [
        'self.total += msg.data',
        'self.total += len(self.text)',
        'self.total = self.total + abs(STEP)',
        'self.total = abs(self.total)',
        'self.share += 1',
        "self.kinds['red'] += 1",
        'self.other += 1',
        'self.total += [1 for _ in msg.data][0]',
        'self.view.seen += 1',
        'old = self.total\ntime.sleep(0.1)\nself.total = old + 1',
        'if self.total < 9:\n    time.sleep(0.1)\n    self.total += 1',
        'if self.total < 9:\n    time.sleep(0.1)\n    self.total = self.total + 1',
    ],
)
def test_an_update_that_others_get_into_is_a_race(update: str) -> None:
    assert told(update) == ['CC304 warning']


@pytest.mark.parametrize(
    ('x', 'y', 'expected'),
    [
        ('self.total += 1', 'self.total += 1', ['CC301 note']),
        ('self.total += 1', 'self.total = 0', ['CC301 note']),
        # What comes in between is wiped out.
        ('self.total += 1', 'print(self.total)\nself.total = 0', ['CC301 warning']),
        ('self.total += 1', 'self.total += len(self.text)', ['CC301 warning']),
        ('self.total += 1', 'old = self.total\nprint()\nself.total = old - 1', ['CC301 warning']),
        ('self.total += msg.data', 'self.total = 0', ['CC301 warning']),
        # A field of a message that takes the place of a number is one.
        ('self.total = msg.data', 'self.total -= 1', ['CC301 note']),
        ('self.total = msg.data', 'if self.total > 3:\n    self.total -= 1', ['CC301 note']),
        ('print(self.total)\nself.total = msg.data', 'self.total -= 1', ['CC301 warning']),
        ('self.total = msg.data()', 'self.total -= 1', ['CC301 warning']),
        ('self.total = msg', 'self.total -= 1', ['CC301 warning']),
    ],
)
def test_of_two_callbacks(x: str, y: str, expected: list[str]) -> None:
    assert told(x, y, 'MutuallyExclusive') == expected
