"""What one run alone does before it makes an entity comes before the callback of that."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.collect import findings_of

NODE = """
import threading
import time
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger

class Base(Node):
    def __init__(self):
        super().__init__('base')
        self.begun = False
        self.ready = False
        self.map = None
        self.group = ReentrantCallbackGroup()
        self.own = MutuallyExclusiveCallbackGroup()
        self.lock = threading.Lock()
        {made}

    def begin(self, request=None, response=None):
        {guard}
        if self.map is None:
            self.map = self.load()
        time.sleep(1.0)
        {body}
        return response

    def watch(self):
        if self.map is None:
            self.map = self.load()

    {further}

    def on_other(self, request, response):
        {other}
        return response

    def load(self):
        return [1]

rclpy.init()
executor = MultiThreadedExecutor(4)
executor.add_node(Base())
executor.spin()
"""
SERVICE = "self.create_service(Trigger, 'begin', self.begin, callback_group=self.{})"
ANY = SERVICE.format('group')
IN_TURN = SERVICE.format('own')
ONE_SHOT = 'self.timer = self.create_timer(1.0, self.begin, callback_group=self.group)'
THREAD = 'threading.Thread(target=self.begin).start()'
OTHER = "self.create_service(Trigger, 'other', self.on_other, callback_group=self.own)"
ONCE = 'if self.begun: return response\n        self.begun = True'
BY_LOCK = (
    'with self.lock:\n            if self.begun: return response\n            self.begun = True'
)
MAKES = 'self.create_timer(1.0, self.watch, callback_group=self.group)'


def _is_told(
    made: str, guard: str, body: str = MAKES, other: str = 'pass', further: str = ''
) -> bool:
    text = NODE.format(made=made, guard=guard, body=body, other=other, further=further)
    races = [f for f in findings_of(scan_text(text).units, [], [None]) if f.code == 'CC301']
    texts = [f.message + ''.join(remark.text for remark in f.related) for f in races]
    return any('Base.begin' in text and 'Base.watch' in text for text in texts)


@pytest.mark.parametrize(
    ('made', 'guard'),
    [
        (ANY, ONCE),
        (ANY, BY_LOCK),
        (IN_TURN, ONCE),
        (ONE_SHOT, 'self.timer.cancel()'),
        (THREAD, 'pass'),
    ],
)
def test_what_one_run_does_before_it_makes_the_timer_is_over(made: str, guard: str) -> None:
    assert not _is_told(made, guard)


FURTHER = f'def watch_it(self): {MAKES}'
CALLS = 'self.watch_it()'


@pytest.mark.parametrize('call', [CALLS, f'if request.data: {CALLS}'])
def test_the_timer_may_be_made_further_in(call: str) -> None:
    assert not _is_told(ANY, ONCE, call, further=FURTHER)


@pytest.mark.parametrize(
    ('made', 'guard', 'body'),
    [
        (ANY, 'pass', MAKES),
        (IN_TURN, 'pass', MAKES),
        (ONE_SHOT, 'pass', MAKES),
        (ONE_SHOT, 'time.sleep(3.0); self.timer.cancel()', MAKES),
        (ONE_SHOT, 'self.timer.cancel(); self.timer.reset()', MAKES),
        ('for _ in range(3): ' + THREAD, 'pass', MAKES),
        (ANY, 'if not self.begun: self.begun = True', MAKES),
    ],
)
def test_a_maker_that_runs_again_meets_the_timer_of_its_first_run(
    made: str, guard: str, body: str
) -> None:
    assert _is_told(made, guard, body)


def test_what_it_does_behind_the_making_is_beside_the_timer() -> None:
    first = f'{ONCE}\n        {MAKES}'
    assert _is_told(ANY, first, 'pass')


def test_a_loop_that_makes_timers_goes_on_beside_the_first() -> None:
    rounds = f'{ONCE}\n        while self.load():\n          if self.map is None: self.map = 1\n'
    assert _is_told(ANY, f'{rounds}          {MAKES}\n        return response', 'pass')


def test_who_lowers_the_flag_lets_a_second_run_meet_the_timer() -> None:
    made = f'{ANY}; {OTHER}'
    assert not _is_told(made, ONCE, other='pass')
    assert _is_told(made, ONCE, other='self.begun = False')


@pytest.mark.parametrize(
    ('made', 'other'),
    [(f'{ANY}; {OTHER}', CALLS), (f'{ANY}; {CALLS}', 'pass'), (f'{CALLS}; {THREAD}', 'pass')],
)
def test_an_entity_that_others_make_too_may_be_there_before(made: str, other: str) -> None:
    guard = 'pass' if THREAD in made else ONCE
    assert _is_told(made, guard, CALLS, other, FURTHER)
