"""CC112: a lock that methods of its object take and give back."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """\
import threading
import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String

class Gate:
    def __init__(self):
        self.mutex = threading.Lock()
        self.mode = 'off'

    def begin(self):
TAKES

    def end(self):
GIVES

class Other:
    def begin(self):
        return 'begun'

    def end(self):
        return 'ended'

class Driver(Node):
    def __init__(self):
        super().__init__('driver')
        self.gate = Gate()
        self.other = Other()
        self.create_subscription(String, 'cmd', self.on_cmd, 10)
        self.create_subscription(String, 'mode', self.on_mode, 10)
        ALSO

    def on_cmd(self, msg):
        self.gate.begin()
        BODY

    def on_mode(self, msg):
        self.gate.begin()
        try:
            self.gate.mode = msg.data
        finally:
            self.gate.end()

rclpy.init()
executor = MultiThreadedExecutor()
executor.add_node(Driver())
executor.spin()
"""
TAKES = [
    'self.mutex.acquire()',
    'self.mutex.acquire()\nreturn self.mode',
    'return self.mutex.acquire()',
]
TRIES = [
    'self.mutex.acquire(timeout=1.0)',
    'self.mutex.acquire(False)',
    'if self.mode:\n    return\nself.mutex.acquire()',
    'if self.mode:\n    self.mutex.acquire()',
]
EARLY = 'if msg.data:\n    return\nself.gate.end()'
IN_ORDER = 'if msg.data:\n    self.gate.end()\n    return\nself.gate.end()'


def kept(
    takes: str, body: str, gives: str = 'self.mutex.release()', also: str = 'pass'
) -> list[str]:
    text = PROGRAM
    for name, code in (('TAKES', takes), ('GIVES', gives)):
        text = text.replace(name, '\n'.join(f'        {line}' for line in code.split('\n')))
    text = text.replace('BODY', body.replace('\n', '\n        ')).replace('ALSO', also)
    found = [each for each in scan_text(text).diagnostics if each.slug == 'lock-kept']
    return [text.split('\n')[each.place.line - 1].strip() for each in found]


@pytest.mark.parametrize('takes', TAKES)
def test_a_function_that_leaves_between_the_two_keeps_it(takes: str) -> None:
    assert kept(takes, EARLY) == ['return']
    assert kept(takes, IN_ORDER) == []
    assert kept(takes, 'if msg.data:\n    self.gate.end()') == ['if msg.data:']


@pytest.mark.parametrize('takes', TRIES)
def test_a_method_that_may_not_take_it_says_nothing(takes: str) -> None:
    assert kept(takes, EARLY) == []


def test_one_that_gives_back_elsewhere_is_left_alone() -> None:
    assert kept(TAKES[0], 'if msg.data:\n    return') == []
    assert kept(TAKES[0], EARLY, gives='print("no lock")') == []


def test_a_name_with_two_meanings_says_nothing() -> None:
    assert kept(TAKES[0], EARLY, also='self.other.begin()') == []


def test_the_message_names_the_methods() -> None:
    text = PROGRAM.replace('TAKES', f'        {TAKES[0]}').replace('ALSO', 'pass')
    text = text.replace('GIVES', '        self.mutex.release()')
    text = text.replace('BODY', EARLY.replace('\n', '\n        '))
    (found,) = scan_text(text).diagnostics
    assert found.message == (
        'on_cmd returns here and keeps self.gate.mutex, taken by self.gate.begin at line 35: the '
        'next one that takes it waits forever'
    )
    assert found.help == 'call self.gate.end in a finally, or give the class a "with"'
