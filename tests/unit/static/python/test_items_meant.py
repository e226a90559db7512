"""Callbacks that each have an item of one container for themselves, and those that share one."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.collect import findings_of

NODE = """
from functools import partial
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node

class A(Node):
    def __init__(self):
        super().__init__('a')
        self.counts = {'left': 0, 'right': 0}
        self.target = self.get_parameter('target').value
        for side in SIDES:
            group = MutuallyExclusiveCallbackGroup()
            self.create_timer(1.0, MADE, callback_group=group)

    def make(self, name):
        def job(*_):
            BODY
        return job

    def count(self, name):
        self.counts[name] += 1

    def shift(self):
        self.count(f'left_{self.target}')

    def move(self, name):
        name = self.target or name
        self.counts[name] += 1
"""
SPUN = """
rclpy.init()
executor = MultiThreadedExecutor(num_threads=3)
executor.add_node(A())
executor.spin()
"""
ASKING = """
    def tick(self):
        client = self.create_client(Trigger, 'go')
        for side in ('left', 'right'):
            client.call_async(Trigger.Request()).add_done_callback(self.make(side))
        self.counts['right'] += 1

"""
BOTH = "('left', 'right')"
TOLD = 'CC301'


@pytest.mark.parametrize(
    ('sides', 'made', 'body', 'told'),
    [
        (BOTH, 'self.make(side)', 'self.counts[name] += 1', []),
        (BOTH, 'self.make(side)', 'self.count(name)', []),
        (BOTH, 'lambda name=side: self.count(name)', 'pass', []),
        (BOTH, 'partial(self.count, side)', 'pass', []),
        (BOTH, 'partial(self.count, name=side)', 'pass', []),
        ('(0, 1)', 'self.make(side)', 'self.counts[name] += 1', []),
        # One item, the last one of the loop, what nobody knows, and what is stored anew.
        ("('left', 'left')", 'self.make(side)', 'self.counts[name] += 1', [TOLD]),
        (BOTH, 'lambda: self.count(side)', 'pass', [TOLD]),
        (BOTH, "self.make('left')", 'self.counts[name] += 1', [TOLD]),
        (BOTH, 'self.make(side)', "self.count('left')", [TOLD]),
        (BOTH, 'self.make(self.name)', 'self.counts[name] += 1', [TOLD]),
        (BOTH, 'partial(self.move, side)', 'pass', [TOLD]),
        (BOTH, 'self.make(side)', 'self.counts = {name: len(self.counts)}', ['CC302']),
    ],
)
def test_two_callbacks_update_one_item_or_each_its_own(
    sides: str, made: str, body: str, told: list[str]
) -> None:
    text = NODE.replace('SIDES', sides).replace('MADE', made).replace('BODY', body) + SPUN
    findings = findings_of(scan_text(text).units, [], [None])
    assert [finding.code for finding in findings if finding.code.startswith('CC3')] == told


def test_a_done_callback_stands_for_all_that_were_made_at_its_place() -> None:
    """They are one callback of the specification, whatever each of them was given."""
    text = NODE.replace('SIDES', "('left',)").replace('MADE', 'self.tick') + SPUN
    text = text.replace('import rclpy\n', 'import rclpy\nfrom std_srvs.srv import Trigger\n', 1)
    text = text.replace('    def make', ASKING + '    def make').replace(
        'BODY', 'self.count(name)'
    )
    codes = [finding.code for finding in findings_of(scan_text(text).units, [], [None])]
    assert 'CC303' in codes


def test_how_a_key_begins_does_not_depend_on_what_is_read() -> None:
    text = NODE.replace('for side in SIDES', 'for job in (self.shift, partial(self.count, "x"))')
    found = findings_of(scan_text(text.replace('MADE', 'job') + SPUN).units, [], [None])
    assert [finding.code for finding in found if finding.code.startswith('CC3')] == []


@pytest.mark.parametrize(
    ('one', 'other', 'told'),
    [
        ('"left"', 'f"right_{self.target}"', []),
        ('f"left_{self.target}"', 'f"right_{self.target}"', []),
        ('"left"', '"right"', []),
        ('"right_1"', 'f"right_{self.target}"', [TOLD]),
        ('f"right_{self.target}"', 'f"right_{self.target}_1"', [TOLD]),
        ('f"{self.target}"', '"right"', [TOLD]),
    ],
)
def test_keys_that_begin_differently_are_two_items(one: str, other: str, told: list[str]) -> None:
    calls = f'(partial(self.count, {one}), partial(self.count, {other}))'
    text = NODE.replace('for side in SIDES', f'for job in {calls}').replace('MADE', 'job')
    findings = findings_of(scan_text(text.replace('BODY', 'pass') + SPUN).units, [], [None])
    assert [finding.code for finding in findings if finding.code.startswith('CC3')] == told
