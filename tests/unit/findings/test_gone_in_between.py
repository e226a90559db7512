"""CC301: an item was found in a collection, and others take it out before it is looked up."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.collect import findings_of

PROGRAM = """\
import threading
import time
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Float32, String


class Fleet(Node):
    def __init__(self):
        super().__init__('fleet')
        self.robots, self.route = {{'base': 1.0}}, []
        self.lock = threading.Lock()
        other = MutuallyExclusiveCallbackGroup()
        self.create_subscription(String, 'gone', self.on_gone, 10, callback_group=other)
        self.create_subscription(String, 'seen', self.on_seen, 10)

    def on_gone(self, msg):
        {takes}

    def on_seen(self, msg):
        name = msg.data
        {looks}


rclpy.init()
executor = MultiThreadedExecutor(num_threads=2)
executor.add_node(Fleet())
executor.spin()
"""
TESTED = 'if name in self.robots:\n            print(name)\n            print(self.robots[name])'
COPIED = 'for name in list(self.robots):\n            print(self.robots[name])'
FIRST = 'if self.route:\n            print(name)\n            print(self.route[0])'
POPS = 'self.robots.pop(msg.data, None)'
LOCKED = 'with self.lock:\n            '


def told(takes: str, looks: str) -> list[tuple[str, str, str]]:
    units = scan_text(PROGRAM.format(takes=takes, looks=looks)).units
    found = findings_of(units, [], [None] * len(units))
    return [
        (each.code, each.severity.value, each.message.rpartition(' ')[2])
        for each in found
        if 'looks it up' in each.message
    ]


@pytest.mark.parametrize(
    'takes', [POPS, 'del self.robots[msg.data]', 'self.robots.clear()', 'self.robots = {}']
)
@pytest.mark.parametrize('looks', [TESTED, COPIED])
def test_what_was_found_is_gone(takes: str, looks: str) -> None:
    assert told(takes, looks) == [('CC301', 'warning', 'KeyError')]


@pytest.mark.parametrize('takes', ['self.route.clear()', 'self.route = []'])
def test_a_list_is_empty_by_then(takes: str) -> None:
    assert told(takes, FIRST) == [('CC301', 'warning', 'IndexError')]


def test_nothing_is_called_in_between() -> None:
    looks = 'if name in self.robots:\n            self.last = self.robots[name]'
    assert told(POPS, looks) == [('CC301', 'note', 'KeyError')]


@pytest.mark.parametrize(
    ('takes', 'looks'),
    [
        # Nobody takes anything out, or what is there stays long enough, or another item goes.
        ('self.robots[msg.data] = 1.0', TESTED),
        ('self.route.pop(0)', FIRST),
        ("self.robots.pop('dock', None)", TESTED.replace('[name]', "['base']")),
        # Nothing was found before, or its lack is expected.
        (POPS, "print(self.robots['base'])"),
        (POPS, TESTED.replace('[name]', '.get(name)')),
        (
            POPS,
            f'try:\n            {COPIED.replace("    ", "        ")}\n        '
            'except KeyError:\n            pass',
        ),
        (POPS, 'for name, since in list(self.robots.items()):\n            print(since)'),
        # One lock over both.
        (f'{LOCKED}{POPS}', LOCKED + TESTED.replace('\n', '\n    ')),
    ],
)
def test_what_was_found_is_still_there(takes: str, looks: str) -> None:
    assert told(takes, looks) == []


def test_a_lock_that_was_given_back_keeps_nothing() -> None:
    """It is taken for the test and for the look, one after the other."""
    looks = (
        'with self.lock:\n            is_here = name in self.robots\n        if is_here:\n'
        '            print(name)\n'
        '            with self.lock:\n                print(self.robots[name])'
    )
    assert told(f'{LOCKED}{POPS}', looks) == [('CC301', 'warning', 'KeyError')]


REPLACED = 'may put others in their place in between'
TAKEN = 'while self.route:\n            {}\n            self.route.pop(0)'


@pytest.mark.parametrize(
    ('takes', 'waits', 'is_told'),
    [
        ('self.route = [msg.data]', 'time.sleep(0.5)', True),
        ('self.route = [msg.data]', 'print(name)', False),
        ('self.route.append(msg.data)', 'time.sleep(0.5)', False),
    ],
)
def test_another_list_stands_in_its_place(takes: str, waits: str, is_told: bool) -> None:
    units = scan_text(PROGRAM.format(takes=takes, looks=TAKEN.format(waits))).units
    found = findings_of(units, [], [None] * len(units))
    assert [each.code for each in found if REPLACED in each.message] == ['CC301'] * is_told
