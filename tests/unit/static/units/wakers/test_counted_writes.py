"""A loop that waits for a number to grow goes on behind as many writes as that takes."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from tests.random_waits.suite import ENDS, FOUND, UNDECIDED, judge

PROGRAM = """\
import threading
import time
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Waiter(Node):
    seen = 0

    def __init__(self):
        super().__init__('waiter')
        self.own = MutuallyExclusiveCallbackGroup()
        self.other = MutuallyExclusiveCallbackGroup()
        self.never = threading.Event()
        self.count = {first}
        self.create_timer(0.1, self.tick_0, callback_group=self.own)
        self.create_timer(0.1, self.tick_1, callback_group=self.other)

    def tick_0(self):
        {before}
        while {test}:
            time.sleep(0.01)

    def tick_1(self):
        {write}
        {then}


rclpy.init()
executor = MultiThreadedExecutor(num_threads=3)
executor.add_node(Waiter())
executor.spin()
"""
PLAIN = {'first': '0', 'before': 'pass', 'test': 'self.count < 2', 'write': 'self.count += 1'}
STAYS, GOES = 'self.never.wait()', 'pass'


def judged(**parts: str) -> str:
    return judge(PROGRAM.format(**{**PLAIN, **parts}))['tick_0']


@pytest.mark.parametrize(
    ('parts', 'expected'),
    [
        ({}, FOUND),
        ({'test': 'self.count <= 1'}, FOUND),
        ({'write': 'self.count = self.count + 1'}, FOUND),
        ({'test': 'self.seen < 2', 'write': 'self.seen += 1'}, FOUND),
        ({'test': 'self.count < 1'}, ENDS),
        ({'first': '1'}, ENDS),
        ({'write': 'self.count += 2'}, ENDS),
        ({'before': 'self.count += 1'}, ENDS),
        ({'write': 'self.count = 5'}, ENDS),
        ({'before': 'if self.never.is_set():\n            self.count += 1'}, FOUND),
        ({'before': 'if self.count_clients("go"):\n            self.count += 1'}, UNDECIDED),
        ({'write': 'for _ in range(2):\n            self.count += 1'}, UNDECIDED),
    ],
)
def test_one_write_may_not_be_enough(parts: dict[str, str], expected: str) -> None:
    assert judged(then=STAYS, **parts) == expected


def test_who_writes_again_and_again_writes_enough() -> None:
    assert judged(then=GOES) == ENDS
    assert judged(then=GOES, test='self.count < 1000') == ENDS


def test_the_specification_says_how_many() -> None:
    unit = scan_text(PROGRAM.format(**{**PLAIN, 'then': STAYS})).units[0]
    (loop,) = (block for block in unit.callbacks[0].blocking if block.call == 'polling loop')
    assert (loop.signals, [waker.by for waker in loop.wakers]) == (2, ['tick_1'])


def test_what_ends_the_wait_of_another_does_not_end_one_behind_it() -> None:
    text = PROGRAM.format(
        **{**PLAIN, 'before': 'self.count += 1', 'write': 'while self.count < 1:'},
        then='    time.sleep(0.01)',
    )
    assert judge(text) == {'tick_0': FOUND, 'tick_1': ENDS}
