"""CC301 and CC302 of threads of the program's own: what overlaps, and what is plainly ordered."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from finding_units import (
    NOT_FOUND,
    ONE_THREAD,
    at,
    calls,
    found,
    only,
    subscription,
    timer,
    unit,
    updates,
    writes,
)

from ros2cc_extract.extract.static.api import scan
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.effects import OUTSIDE, Access, Act, Blocking, Waker
from ros2cc_extract.spec.model import Activity, ActivityKind, Callback, Executor, Spec

KIND = ActivityKind


def thread(name: str = 'work', kind: ActivityKind = KIND.THREAD, **facts: Any) -> Activity:
    function = facts.pop('function', f'arm.Arm.{name}')
    return Activity(name=name, kind=kind, function=function, node='arm', cls='Arm', **facts)


def beside(
    *activities: Activity,
    callbacks: tuple[Callback, ...] = (),
    executor: Executor = ONE_THREAD,
) -> Spec:
    return replace(unit(executor, *callbacks), activities=activities)


def races(*activities: Activity, callbacks: tuple[Callback, ...] = (), **facts: Any) -> list[str]:
    told = found(beside(*activities, callbacks=callbacks, **facts))
    return [code for code in told if code.startswith('CC3')]


TICK = timer('tick', writes=updates('Arm.count', 30))
RESET = subscription('on_reset', defined=at(35), writes=writes('Arm.count', 40))
WORK = thread(writes=updates('Arm.count', 60))


@pytest.mark.parametrize(
    ('work', 'expected'),
    [
        (WORK, ['CC301:30 warning']),
        (thread(kind=KIND.PROCESS, writes=WORK.writes), []),
        (thread(writes=WORK.writes, ends_first=True), []),
        (replace(WORK, node='leg'), []),
        (replace(WORK, unresolved=Unknown('an argument')), []),
        (replace(WORK, kind=KIND.MAIN, function='main', node=None), ['CC301:30 warning']),
    ],
)
def test_a_thread_overlaps_the_callbacks_of_an_executor_with_one_thread(
    work: Activity, expected: list[str]
) -> None:
    assert races(work, callbacks=(TICK,)) == expected


def test_nothing_is_said_where_the_executor_is_not_known() -> None:
    assert races(WORK, callbacks=(TICK,), executor=NOT_FOUND) == []


def test_a_common_lock_keeps_them_apart() -> None:
    locked = replace(TICK, writes=updates('Arm.count', 30, 'lock'))
    work = replace(WORK, writes=updates('Arm.count', 60, 'lock'))
    assert races(work, callbacks=(locked,)) == []
    assert races(WORK, callbacks=(locked,)) == ['CC301:30 warning']


def test_the_words_name_the_thread_and_its_function() -> None:
    work = replace(WORK, name='worker')
    finding = only(beside(work, callbacks=(RESET,)), 'CC301')
    assert finding.message == (
        'thread worker (work) updates Arm.count from its old value, and on_reset may write it at '
        'the same time: one change can get lost'
    )
    assert finding.help == 'hold one lock around both; a callback group cannot help'


def test_a_flag_that_a_loop_reads_and_its_end_puts_down_is_a_note() -> None:
    reads = (Access(name='Arm.running', source=at(60)),)
    work = thread(reads=reads, writes=writes('Arm.running', 65))
    stop = subscription('on_stop', writes=writes('Arm.running', 40))
    assert races(work, callbacks=(stop,)) == ['CC302:40 note']
    assert races(thread(reads=reads), callbacks=(stop,)) == []


@pytest.mark.parametrize(('constant', 'weight'), [(True, 'note'), (False, 'warning')])
def test_a_test_of_a_flag_weighs_less_than_a_computed_value(constant: bool, weight: str) -> None:
    write = Access(name='Arm.state', source=at(62), rests=True, constant=constant)
    work = thread(reads=(Access(name='Arm.state', source=at(60)),), writes=(write,))
    ask = subscription('on_ask', writes=writes('Arm.state', 40))
    assert races(work, callbacks=(ask,)) == [f'CC301:62 {weight}']


def starting(*lines: int, join: int | None = None, start: int = 45) -> Spec:
    """``on_go`` starts a thread that updates what it writes in ``lines``, and may join it."""
    block = Blocking(call='Thread.join', source=at(join or 0), wakers=(Waker(by='work'),))
    go = subscription(
        'on_go',
        defined=at(35),
        writes=tuple(Access(name='Arm.count', source=at(line)) for line in lines),
        blocking=(block,) if join else (),
    )
    work = replace(WORK, starts=(Waker(by='on_go', source=at(start), after=0),))
    return beside(work, callbacks=(go,))


@pytest.mark.parametrize(
    ('spec', 'expected'),
    [
        (starting(40), []),
        (starting(47), ['CC301:60 warning']),
        (starting(47, join=46), []),
        (starting(47, join=50), ['CC301:60 warning']),
        (starting(47, start=20), []),
    ],
)
def test_what_its_starter_does_before_the_start_and_after_the_join_is_ordered(
    spec: Spec, expected: list[str]
) -> None:
    assert [code for code in found(spec) if code.startswith('CC3')] == expected


def test_a_thread_that_its_starter_joins_overlaps_what_the_starter_overlaps() -> None:
    spec = starting(join=50)
    with_timer = replace(spec, callbacks=(*spec.callbacks, TICK))
    assert [code for code in found(with_timer) if code.startswith('CC3')] == []
    unjoined = replace(starting(), callbacks=(*starting().callbacks, TICK))
    assert 'CC301:30 warning' in found(unjoined)


def test_main_has_joined_the_thread_that_spins() -> None:
    join = Blocking(call='Thread.join', source=at(80), wakers=(Waker(by=OUTSIDE),))
    late = thread('main', KIND.MAIN, writes=writes('Arm.count', 85), blocking=(join,))
    assert races(late, callbacks=(TICK,)) == []
    assert races(replace(late, blocking=()), callbacks=(TICK,)) == ['CC301:30 warning']


def test_what_main_has_waited_for_comes_first() -> None:
    wait = Blocking(call='Event.wait', source=at(80), wakers=(Waker(by='tick'),))
    late = thread('main', KIND.MAIN, writes=writes('Arm.count', 85), blocking=(wait,))
    assert races(late, callbacks=(TICK,)) == []


def test_what_main_does_before_it_makes_an_entity_comes_before_its_callback() -> None:
    made = (Act(name='timer', source=at(28)),)
    early = thread('main', KIND.MAIN, writes=writes('Arm.count', 27), changes=made)
    tick = replace(TICK, source=at(28))
    assert races(early, callbacks=(tick,)) == []
    late = replace(early, writes=writes('Arm.count', 29))
    assert races(late, callbacks=(tick,)) == ['CC301:30 warning']


def test_two_threads_race_and_tasks_of_pools_may_take_turns() -> None:
    other = thread('other', writes=writes('Arm.count', 70))
    assert races(WORK, other, callbacks=()) == ['CC301:60 warning']
    tasks = [replace(each, kind=KIND.POOL) for each in (WORK, other)]
    assert races(*tasks) == []
    assert races(*(replace(each, conditional=True) for each in (WORK, other))) == []


@pytest.mark.parametrize(
    ('facts', 'expected'),
    [
        ({'count': 3}, ['CC301:60 warning']),
        ({'count': Unknown('started each time the callback runs')}, ['CC301:60 warning']),
        ({'count': 1}, []),
        ({'count': 3, 'kind': KIND.POOL}, []),
        ({'count': 3, 'conditional': True}, []),
        ({'count': 3, 'starts': (Waker(by='work'),)}, []),
    ],
)
def test_several_threads_that_run_the_same(facts: dict[str, Any], expected: list[str]) -> None:
    assert races(replace(WORK, **facts)) == expected


def test_threads_of_one_method_may_be_those_of_different_objects() -> None:
    twin = replace(WORK, name='work_2')
    assert races(WORK, twin, callbacks=(TICK,)) == []


def test_two_that_wait_for_each_other_go_by_turns() -> None:
    asks = replace(WORK, blocking=calls('tick', call='Event.wait', wakers=(Waker(by='tick'),)))
    turns = replace(TICK, blocking=calls('work', call='Event.wait', wakers=(Waker(by='work'),)))
    assert races(asks, callbacks=(turns,)) == []
    assert races(asks, callbacks=(TICK,)) == ['CC301:30 warning']


def test_a_callback_of_another_branch_is_not_there_with_the_thread() -> None:
    step = replace(TICK, alternative='either')
    assert races(WORK, callbacks=(step,)) == []
    skipped = replace(TICK, conditional=True)
    assert races(WORK, callbacks=(skipped,)) == ['CC301:30 warning']
    assert races(replace(WORK, conditional=True), callbacks=(skipped,)) == []


NODE = """\
import threading

import rclpy
from rclpy.node import Node


class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.count = 0
        self.lock = threading.Lock()
        self.create_timer(0.1, self.tick)
        threading.Thread(target=self.work, daemon=True).start()

    def work(self):
        while rclpy.ok():
            with {first}:
                self.count += {step}

    def tick(self):
        with {second}:
            self.count += {step}


rclpy.init()
rclpy.spin(Arm())
"""


@pytest.mark.parametrize(
    ('first', 'step', 'expected'),
    [
        ('threading.Lock()', 'len(self.get_name())', ['CC301:22 warning']),
        ('self.lock', 'len(self.get_name())', []),
        ('threading.Lock()', '1', ['CC301:22 note']),
        ('self.lock', '1', []),
    ],
)
def test_from_source(first: str, step: str, expected: list[str], tmp_path: Path) -> None:
    path = tmp_path / 'arm.py'
    path.write_text(NODE.format(first=first, second='self.lock', step=step), encoding='utf-8')
    (spec,) = scan([path], root=tmp_path).units
    assert [code for code in found(spec) if code.startswith('CC3')] == expected


HANDED_ON = """
import rclpy, threading, time
from rclpy.node import Node

class Link(threading.Thread):
    def __init__(self, rows):
        super().__init__(daemon=True)
        self.lines = rows

    def run(self):
        while True:
            for row in {over}:
                time.sleep(0.1)

def show(rows):
    while True:
        for row in {local}:
            time.sleep(0.1)

class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.rows = {{}}
        self.link = Link(self.rows)
        self.link.start()
        threading.Thread(target=show, args=(self.rows,), daemon=True).start()
        self.create_timer(0.1, self.tick)

    def tick(self):
        self.rows[time.time()] = 1

    {more}

class Leg(Node):
    def __init__(self):
        super().__init__('leg')
        self.create_timer(0.1, self.tick)

    def tick(self):
        pass

rclpy.init()
executor = rclpy.executors.SingleThreadedExecutor()
executor.add_node(Arm())
executor.add_node(Leg())
executor.spin()
"""


@pytest.mark.parametrize(
    ('texts', 'expected'),
    [
        (('self.lines.items()', 'list(rows)'), ['CC301:12 warning']),
        (('list(self.lines.items())', 'rows.values()'), ['CC301:17 warning']),
        (('list(self.lines.items())', 'list(rows)'), []),
        (('dict(self.lines)', 'sorted(rows)'), []),
        (('self.lines.copy()', 'rows.copy().items()'), []),
    ],
)
def test_a_collection_handed_to_a_thread_is_the_same_one(
    texts: tuple[str, str], expected: list[str], tmp_path: Path
) -> None:
    assert _handed_on(*texts, tmp_path) == expected


def test_a_collection_is_the_same_one_until_it_is_replaced(tmp_path: Path) -> None:
    more = 'def reset(self): self.rows = {}'
    assert _handed_on('self.lines', 'list(rows)', tmp_path, more) == ['CC301:12 warning']
    assert _handed_on('list(self.lines)', 'rows', tmp_path, more) == ['CC301:17 warning']
    assert _handed_on('list(self.lines)', 'list(rows)', tmp_path, more) == []


def _handed_on(over: str, local: str, folder: Path, more: str = 'pass') -> list[str]:
    path = folder / 'arm.py'
    path.write_text(HANDED_ON.format(over=over, local=local, more=more), encoding='utf-8')
    (spec,) = scan([path], root=folder).units
    return [code for code in found(spec) if code.startswith('CC3')]
