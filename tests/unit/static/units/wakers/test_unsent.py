"""Waits for messages that this program sends itself, and not while the wait lasts."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """
import threading
import time
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import {executor}
from rclpy.node import Node
from std_msgs.msg import Empty

class Waiter(Node):
    def __init__(self):
        super().__init__('waiter')
        own = {group}()
        other = MutuallyExclusiveCallbackGroup()
        self.come, self.told = threading.Event(), threading.Condition()
        self.has_come = False
        self.go = self.create_publisher(Empty, 'go', 10)
        self.step = self.create_publisher(Empty, 'step', 10)
        self.create_subscription(Empty, '/go', self.on_go, 10)
        self.create_subscription(Empty, 'step', self.on_step, 10, callback_group=other)
        self.create_timer(0.1, self.ask, callback_group=own)
        self.create_timer(0.1, self.tell, callback_group={of_tell})

    def on_go(self, message):
        self.come.set()
        self.has_come = True
        with self.told:
            self.told.notify_all()

    def on_step(self, message):
        {on_step}

    {kind} ask(self):
        {ask}

    def tell(self):
        {tell}

rclpy.init()
executor = {executor}({threads})
executor.add_node(Waiter())
executor.spin()
"""
GO, STEP = 'self.go.publish(Empty())', 'self.step.publish(Empty())'
WAIT = 'self.come.wait(); self.come.clear()'
POLL = 'while not self.has_come:\n            time.sleep(0.1)'
HOLD = f'with self.told:\n            {GO}\n            self.told.wait()'
LATE = f'{GO}\n        with self.told:\n            self.told.wait()'


def _unsent(
    ask: str = WAIT,
    *,
    tell: str = GO,
    on_step: str = 'pass',
    group: str = 'MutuallyExclusiveCallbackGroup',
    of_tell: str = 'own',
    threads: str = 'num_threads=4',
) -> list[str | None]:
    executor = 'MultiThreadedExecutor' if threads else 'SingleThreadedExecutor'
    program = PROGRAM.format(
        ask=ask,
        tell=tell,
        on_step=on_step,
        group=group,
        of_tell=of_tell,
        executor=executor,
        threads=threads,
        kind='async def' if 'await' in ask else 'def',
    )
    (unit,) = scan_text(program).units
    (doer,) = [each for each in unit.callbacks if each.name == 'ask']
    return [block.unsent for block in doer.blocking if block.call != 'time.sleep']


@pytest.mark.parametrize('ask', [WAIT, POLL, LATE])
def test_a_group_mate_publishes_nothing_meanwhile(ask: str) -> None:
    assert _unsent(ask) == ['go']


def test_who_publishes_behind_the_wait_alone() -> None:
    assert _unsent(f'{WAIT}\n        {GO}', tell='pass') == ['go']


def test_who_is_set_off_by_a_group_mate_alone() -> None:
    assert _unsent(tell=STEP, on_step=GO) == ['go']
    assert _unsent(f'{STEP}\n        {WAIT}', tell='pass', on_step=GO) == [None]


def test_what_only_its_own_kind_of_message_sets_off() -> None:
    assert _unsent(tell=STEP, on_step=f'{STEP}; {GO}') == ['go']


def test_an_event_that_stays_set_is_waited_for_once() -> None:
    assert _unsent('self.come.wait(); self.come.wait()') == ['go', None]


@pytest.mark.parametrize(
    ('ask', 'changed'),
    [
        (WAIT, {'of_tell': 'None'}),
        (WAIT, {'group': 'ReentrantCallbackGroup'}),
        (WAIT, {'tell': 'pass'}),  # no known code publishes: it is taken to come by itself
        (WAIT, {'tell': STEP}),
        ('self.come.wait(timeout=1.0)', {}),
        (f'{GO}; {WAIT}', {}),
        (POLL.replace('time.sleep(0.1)', f'{GO}'), {}),
        (HOLD, {}),
    ],
)
def test_what_may_be_sent(ask: str, changed: dict[str, str]) -> None:
    assert set(_unsent(ask, **changed)) <= {None}


def test_where_the_waker_itself_is_kept_out_the_model_says_so() -> None:
    assert _unsent(of_tell='None', threads='') == [None]
