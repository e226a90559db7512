"""Locks that all take in one order are no deadlock, and are given back."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.collect import findings_of

PROGRAM = """\
import threading
from contextlib import ExitStack
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Account:
    def __init__(self, name):
        self.name = name
        self.lock = threading.Lock()


class Bank(Node):
    def __init__(self):
        super().__init__('bank')
        self.a, self.b = threading.Lock(), threading.Lock()
        self.left, self.right = Account('left'), Account('right')
        self.create_timer(0.1, self.first, callback_group=MutuallyExclusiveCallbackGroup())
        self.create_timer(0.1, self.second, callback_group=MutuallyExclusiveCallbackGroup())

    def first(self):
        self.move(self.a, self.b, self.left, self.right)

    def second(self):
        self.move(self.b, self.a, self.right, self.left)

    def move(self, a, b, one, other):
        {}


rclpy.init()
executor = MultiThreadedExecutor(num_threads=3)
executor.add_node(Bank())
executor.spin()
"""


def codes(*lines: str) -> set[str]:
    units = scan_text(PROGRAM.format('\n        '.join(lines))).units
    return {found.code for found in findings_of(units, ())} & {'CC110', 'CC111', 'CC112', 'CC120'}


@pytest.mark.parametrize(
    'lines',
    [
        (
            'locks = sorted([a, b], key=id)',
            'for lock in locks:',
            '    lock.acquire()',
            'for lock in reversed(locks):',
            '    lock.release()',
        ),
        (
            'for each in sorted((one, other), key=lambda account: account.name):',
            '    each.lock.acquire()',
            'for each in (one, other):',
            '    each.lock.release()',
        ),
        (
            'with ExitStack() as stack:',
            '    for lock in sorted((a, b), key=id):',
            '        stack.enter_context(lock)',
        ),
        (
            'low, high = sorted((one, other), key=lambda account: account.name)',
            'with low.lock, high.lock:',
            '    pass',
        ),
    ],
)
def test_locks_that_are_sorted_first_are_clean(lines: tuple[str, ...]) -> None:
    assert codes(*lines) == set()


def test_in_the_order_of_who_calls_they_are_a_deadlock() -> None:
    assert codes('with a, b:', '    pass') == {'CC111'}
