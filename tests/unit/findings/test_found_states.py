"""Code that writes in one state only, beside code that writes in another one only."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.base.model import Finding
from ros2cc_extract.findings.collect import findings_of

PROGRAM = """\
import threading
import time
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String

class Crane(Node):
    def __init__(self):
        super().__init__('crane')
        self.lock = threading.Lock()
        self.load = START
        self.weight = 0
        groups = [MutuallyExclusiveCallbackGroup() for _ in range(3)]
        OTHERS
        self.create_subscription(String, 'hook', self.on_hook, 10, callback_group=groups[0])
        self.create_timer(1.0, self.lower, callback_group=groups[1])

    def on_hook(self, msg):
        HOOK

    def lower(self):
        LOWER

    def reset(self):
        RESET

rclpy.init()
executor = MultiThreadedExecutor(4)
executor.add_node(Crane())
executor.spin()
"""
RESET = 'self.create_timer(9.0, self.reset, callback_group=groups[2])'
TWO = 'for _ in range(2):\n            threading.Thread(target=self.lower).start()'

IF_NONE = 'if self.load is None:\n            self.load = msg.data'
IF_SOME = """\
if self.load is not None:
            time.sleep(0.5)
            self.load = self.weight"""
COPIED = """\
load = self.load
        if load is None:
            return
        time.sleep(0.5)
        self.load = self.weight"""
IN_ROUNDS = """\
while rclpy.ok():
            load = self.load
            if load is None:
                continue
            time.sleep(0.5)
            self.load = self.weight"""
COPIED_BEFORE = """\
load = self.load
        while rclpy.ok():
            if load is not None:
                time.sleep(0.5)
                self.load = self.weight"""
COPY_STORED_ANEW = """\
load = self.load
        self.load = None
        if load is not None:
            time.sleep(0.5)
            self.load = self.weight"""
STORED_AND_ASKED_AGAIN = """\
load = self.load
        if load is not None:
            self.load = None
            time.sleep(0.5)
            if load is not None:
                self.load = self.weight"""
COPIED_IN_PART = """\
load = self.weight
        if self.weight > 3:
            load = self.load
        if load is not None:
            time.sleep(0.5)
            self.load = self.weight"""
STORED_IN_ROUNDS = """\
if self.load is not None:
            while rclpy.ok():
                self.load = self.weight
                time.sleep(0.5)"""
LIKE_AN_ATTRIBUTE = """\
load = self.weight
        if self.load != 3 and load is not None:
            time.sleep(0.5)
            self.load = self.weight"""
COPIED_UNDER_LOCK = """\
with self.lock:
            load = self.load
        if load is not None:
            time.sleep(0.5)
            with self.lock:
                self.load = self.weight"""
SLOW = """\
if self.load is None:
            time.sleep(0.5)
            self.load = msg.data"""
RAISED = 'if not self.load:\n            self.load = True'
LOWERED = 'if self.load:\n            time.sleep(0.5)\n            self.load = False'
IF_IDLE = "if self.load == 'idle':\n            self.load = 'held'"
IF_HELD = """\
if self.load == 'held':
            time.sleep(0.5)
            self.load = self.weight"""


def findings(
    hook: str, lower: str, reset: str = 'pass', others: str = 'pass', start: str = 'None'
) -> list[Finding]:
    text = PROGRAM.replace('HOOK', hook).replace('LOWER', lower).replace('RESET', reset)
    units = scan_text(text.replace('OTHERS', others).replace('START', start)).units
    found = findings_of(units, [], [None])
    return [finding for finding in found if finding.code.startswith('CC3')]


def races(hook: str, lower: str, others: str = 'pass', start: str = 'None') -> list[str]:
    return [finding.code for finding in findings(hook, lower, others=others, start=start)]


@pytest.mark.parametrize(
    ('hook', 'lower', 'start'),
    [
        (IF_NONE, IF_SOME, 'None'),
        (IF_NONE, COPIED, 'None'),
        (IF_NONE, IN_ROUNDS, 'None'),
        (IF_NONE, COPIED_UNDER_LOCK, 'None'),
        (SLOW, COPIED_UNDER_LOCK, 'None'),
        (SLOW, IF_SOME, 'None'),
        (IF_IDLE, IF_HELD, "'idle'"),
        (IF_IDLE.replace('==', '!='), IF_HELD.replace("'held'", "'idle'"), "'idle'"),
    ],
)
def test_what_the_other_finds_keeps_it_away(hook: str, lower: str, start: str) -> None:
    assert races(hook, lower, start=start) == []


def test_runs_of_one_callback_are_told_of_that_one() -> None:
    hook = IF_NONE.replace('is None', 'is False').replace('msg.data', 'True')
    lower = IF_SOME.replace('is not None', '').replace('self.weight', 'False')
    anew = 'groups[0] = groups[1] = ReentrantCallbackGroup()'
    assert races(hook, lower, others=anew, start='False') == ['CC304', 'CC304']


@pytest.mark.parametrize(
    ('hook', 'lower'),
    [
        # It stores whatever is there, or asks for something that may be at the same time.
        ('self.load = msg.data', IF_SOME),
        ("self.load = 'box'", IF_SOME),
        (IF_NONE.replace('is None', '!= 3'), IF_SOME),
        (IF_NONE.replace('self.load is None', 'msg.data'), IF_SOME),
        # What the copy was may be over by the own write before.
        (IF_NONE, COPIED_BEFORE),
        (IF_NONE, COPY_STORED_ANEW),
        (IF_NONE, STORED_AND_ASKED_AGAIN),
        (IF_NONE, COPIED_IN_PART),
        (IF_NONE, STORED_IN_ROUNDS),
        (IF_NONE, LIKE_AN_ATTRIBUTE),
        # Both may find the same number.
        (IF_IDLE.replace("'idle'", '1'), IF_HELD.replace("'held'", 'True')),
        (IF_IDLE.replace('==', '!='), IF_HELD),
    ],
)
def test_it_may_come_in_between(hook: str, lower: str) -> None:
    assert races(hook, lower) != []


TICK = 'self.create_timer(1.0, self.lower, callback_group=groups[1])'
ASK = 'self.create_timer(1.0, self.ask, callback_group=groups[1])'
ASKED = """\
def ask(self):
        request = Empty.Request()
        self.client.call_async(request).add_done_callback(lambda _: self.lower())

    def reset(self):"""


@pytest.mark.parametrize(('raised', 'told'), [('not self.load', []), ('msg.data', ['CC303'])])
def test_two_that_switch_a_flag_in_opposite_directions(raised: str, told: list[str]) -> None:
    """One of them is in no group: the one that runs last decides, and nothing gets lost."""
    text = PROGRAM.replace('START', 'False').replace(TICK, ASK).replace('RESET', 'pass')
    text = text.replace('def reset(self):', ASKED).replace(
        'import String', 'import String\nfrom std_srvs.srv import Empty'
    )
    text = text.replace('OTHERS', "self.client = self.create_client(Empty, 'empty')")
    hook = f'if {raised}:\n            self.load = True'
    text = text.replace('HOOK', hook).replace('LOWER', LOWERED)
    found = findings_of(scan_text(text).units, [], [None])
    races = [each.code for each in found if each.code in ('CC301', 'CC303')]
    assert races == told


@pytest.mark.parametrize(
    ('hook', 'lower', 'reset', 'told'),
    [
        (RAISED, LOWERED, 'self.load = False', {'Crane.load', 'lower', 'on_hook'}),
        (IF_NONE, IF_SOME, 'self.load = None', {'Crane.load', 'lower', 'on_hook', 'reset'}),
        # A load that comes while another one is lowered is lost by that code, and by no other.
        (IF_NONE, IF_SOME, "self.load = 'box'", {'Crane.load', 'lower', 'reset', 'on_hook'}),
    ],
)
def test_others_may_bring_about_the_state_of_the_other(
    hook: str, lower: str, reset: str, told: set[str]
) -> None:
    start = 'None' if hook is IF_NONE else 'False'
    found = findings(hook, lower, reset, RESET, start)
    assert [(each.code, {*each.subjects}) for each in found] == [('CC301', told)]


def test_code_of_several_threads() -> None:
    found = findings(IF_NONE, IF_SOME, others=TWO)
    told = {'Crane.load', 'lower', 'lower_2', 'on_hook'}
    assert [(each.code, {*each.subjects}) for each in found] == [('CC301', told)]
