"""CC3xx: shared state, decided by the model's verdict or by groups and threads."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from finding_units import (
    FILE,
    NOT_FOUND,
    ONE_THREAD,
    appends,
    at,
    callback,
    calls,
    default_threads,
    exclusive,
    found,
    only,
    outside,
    subscription,
    threads,
    timer,
    unit,
    updates,
    writes,
)

from ros2cc_extract.checker.api import Verdict
from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.extract.static.api import scan
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.effects import Access, Act
from ros2cc_extract.spec.model import Callback, EntityKind, Executor, Spec, When
from ros2cc_extract.verify.results.evidence import Evidence, Moment, Sentence
from ros2cc_extract.verify.results.results import QueryResult, Verification

RUN = Evidence(
    start={'thread_0': 'idle'},
    moments=(
        Moment(
            number=1,
            sentences=(Sentence('thread_0', 'tick starts on thread_0'),),
            places=(('tick', at(10)),),
            changes={},
        ),
    ),
    cycle_from=None,
    ends=None,
)


def verified(verdict: Verdict, *pair: str) -> Verification:
    result = QueryResult(
        family='can_overlap',
        formula='E<> …',
        words='…',
        callbacks=pair,
        verdict=verdict,
        reason=None,
        seconds=0.0,
        run=RUN if verdict is Verdict.SATISFIED else None,
    )
    return Verification(
        model='arm',
        profile='paper',
        text='plain',
        engine='reference',
        states=1,
        transitions=1,
        seconds=0.0,
        peak_mb=1.0,
        complete=True,
        results=(result,),
    )


def counter(executor: Executor, reset_group: str = 'other', **of_reset: object) -> Spec:
    return unit(
        executor,
        timer('tick', writes=updates('Arm.count', 30)),
        subscription('on_reset', reset_group, writes=writes('Arm.count', 35), **of_reset),
    )


def races(spec: Spec, verification: Verification | None = None) -> list[str]:
    return [code for code in found(spec, verification) if code.startswith('CC3')]


@pytest.mark.parametrize(
    ('spec', 'expected'),
    [
        (counter(threads(2)), ['CC301:30 warning']),
        (counter(threads(2), 'arm_default'), []),
        (counter(threads(1)), []),
        (counter(default_threads(1)), ['CC301:30 warning']),
        (counter(threads(2), alternative='either'), ['CC301:30 warning']),
        (counter(ONE_THREAD), []),
        (counter(NOT_FOUND), []),
        (counter(threads(2), node='leg'), []),
        (counter(threads(2), node=Unknown('an argument')), []),
    ],
)
def test_groups_and_threads_decide_where_no_verdict_is(spec: Spec, expected: list[str]) -> None:
    assert races(spec) == expected


@pytest.mark.parametrize(
    ('verdict', 'expected'),
    [
        (Verdict.SATISFIED, ['CC301:30 warning']),
        (Verdict.NOT_SATISFIED, []),
        (Verdict.UNDECIDED, ['CC301:30 warning']),
    ],
)
def test_the_verdict_of_the_model_goes_before(verdict: Verdict, expected: list[str]) -> None:
    assert races(counter(threads(2)), verified(verdict, 'on_reset', 'tick')) == expected


def test_branches_of_which_only_one_is_taken_do_not_race() -> None:
    spec = unit(
        threads(2),
        timer('tick', alternative='either', writes=updates('Arm.count', 30)),
        subscription('on_reset', 'other', alternative='either', writes=writes('Arm.count', 35)),
    )
    assert races(spec) == []


@pytest.mark.parametrize(('branch', 'expected'), [(0, ['CC301:30 warning']), (1, [])])
def test_callbacks_of_one_branch_may_race(branch: int, expected: list[str]) -> None:
    update, write = updates('Arm.count', 30), writes('Arm.count', 35)
    spec = unit(
        threads(2),
        timer('tick', alternative='either', branch=0, writes=update),
        subscription('on_reset', 'other', alternative='either', branch=branch, writes=write),
    )
    assert races(spec) == expected


def test_the_run_of_the_model_is_the_evidence() -> None:
    verification = verified(Verdict.SATISFIED, 'tick', 'on_reset')
    finding = only(counter(threads(2)), 'CC301', verification)
    assert finding.run is RUN
    assert [(remark.place, remark.text) for remark in finding.related] == [
        (at(35), 'on_reset writes Arm.count here')
    ]
    assert finding.message == (
        'tick updates Arm.count from its old value, and on_reset may write it at the same time: '
        'one change can get lost'
    )


def test_a_common_lock_protects_and_two_locks_do_not() -> None:
    def spec(lock: str) -> Spec:
        return unit(
            threads(2),
            timer('tick', writes=updates('Arm.count', 30, 'Arm.lock')),
            subscription('on_reset', 'other', writes=writes('Arm.count', 35, lock)),
        )

    assert races(spec('Arm.lock')) == []
    assert races(spec('Arm.other_lock')) == ['CC301:30 warning']


@pytest.mark.parametrize(
    ('one', 'other', 'expected'),
    [
        ('rw', 'rw (shared)', []),
        ('rw (shared)', 'rw', []),
        ('rw (shared)', 'rw (shared)', ['CC301:30 warning']),
        ('rw (shared)', 'mode', ['CC301:30 warning']),
    ],
)
def test_readers_hold_a_lock_together(one: str, other: str, expected: list[str]) -> None:
    spec = unit(
        threads(2),
        timer('tick', writes=updates('Arm.count', 30, one)),
        subscription('on_reset', 'other', writes=writes('Arm.count', 35, other)),
    )
    assert races(spec) == expected


def test_an_unresolved_group_gives_nothing() -> None:
    group = exclusive('other', unresolved=Unknown('an argument'))
    spec = unit(
        threads(2),
        timer('tick', 'other', writes=updates('Arm.count', 30)),
        subscription('on_reset', 'g', writes=writes('Arm.count', 35)),
        groups=(group, exclusive('g')),
    )
    assert races(spec) == []


def resting(accesses: tuple[Access, ...]) -> tuple[Access, ...]:
    return tuple(replace(access, rests=True) for access in accesses)


def test_plain_assignments_are_a_note_and_a_test_before_makes_it_a_warning() -> None:
    plain = timer('tick', writes=writes('Arm.goal', 30))
    tested = timer('tick', reads=writes('Arm.goal', 29), writes=resting(writes('Arm.goal', 30)))
    shown = timer('tick', reads=writes('Arm.goal', 29), writes=writes('Arm.goal', 30))
    other = subscription('on_goal', 'other', writes=writes('Arm.goal', 35))
    assert races(unit(threads(2), plain, other)) == ['CC302:30 note']
    assert races(unit(threads(2), shown, other)) == ['CC302:30 note']
    assert races(unit(threads(2), tested, other)) == ['CC301:30 warning']
    assert races(unit(threads(2), other, tested)) == ['CC301:30 warning']


def test_updates_in_place_do_not_disturb_each_other() -> None:
    def spec(accesses: tuple[Access, ...]) -> Spec:
        log = timer('tick', writes=appends('Arm.log', 30))
        return unit(threads(2), log, subscription('on_log', 'free', writes=accesses))

    assert races(spec(appends('Arm.log', 35))) == []
    assert races(spec(writes('Arm.log', 35))) == ['CC302:30 note']
    assert races(spec(updates('Arm.log', 35)))[0] == 'CC301:35 warning'


def item_set(reads: tuple[Access, ...], line: int = 30) -> Callback:
    """``Arm.table[k] = …``, which looks the table up at the place of the write too."""
    looked_up = writes('Arm.table', line)
    stored = appends('Arm.table', line)
    return timer('tick', reads=(*reads, *looked_up), writes=resting(stored) if reads else stored)


def test_who_takes_an_item_finds_it_whatever_others_put_in() -> None:
    def moving(name: str, group: str, line: int, moves: str) -> Callback:
        write = replace(appends('Arm.table', line)[0], moves=moves, rests=True)
        return timer(name, group, reads=writes('Arm.table', line - 1), writes=(write,))

    takes = moving('tick', 'arm_default', 30, 'takes')
    puts = subscription(
        'put', 'other', writes=(replace(appends('Arm.table', 35)[0], moves='adds'),)
    )
    assert races(unit(threads(2), takes, puts)) == []
    assert races(unit(threads(2), takes, moving('steal', 'other', 35, 'takes'))) == [
        'CC301:30 note'
    ]


def test_a_change_in_place_of_what_was_read_before() -> None:
    other = subscription('on_set', 'other', writes=appends('Arm.table', 35))
    above = writes('Arm.table', 29)
    in_value = (Access(name='Arm.table', source=Place(FILE, 30, 27)),)
    below = writes('Arm.table', 31)
    assert races(unit(threads(2), item_set(above), other)) == ['CC301:30 note']
    assert races(unit(threads(2), other, item_set(above))) == ['CC301:30 note']
    assert races(unit(threads(2), item_set(in_value), other)) == ['CC301:30 note']
    assert races(unit(threads(2), item_set(below), other)) == []
    assert races(unit(threads(2), item_set(()), other)) == []
    assert races(unit(ONE_THREAD, item_set(above), other)) == []
    reset = subscription('on_reset', 'other', writes=writes('Arm.table', 35))
    assert races(unit(threads(2), item_set(above), reset)) == ['CC301:30 note']
    assert only(unit(threads(2), item_set(above), other), 'CC301').message == (
        'tick reads Arm.table and then changes it in place, and on_set may change it in between: '
        'what was read may no longer hold'
    )


def test_setting_two_items_is_no_reading() -> None:
    two = timer(
        'tick',
        reads=(*writes('Arm.table', 30), *writes('Arm.table', 31)),
        writes=(*appends('Arm.table', 30), *appends('Arm.table', 31)),
    )
    other = subscription('on_set', 'other', writes=appends('Arm.table', 35))
    assert races(unit(threads(2), two, other)) == []


def test_a_lock_around_reading_and_changing_protects() -> None:
    def locked(line: int, in_place: bool) -> tuple[Access, ...]:
        place = at(line)
        return (Access(name='Arm.table', source=place, locks=('lock',), in_place=in_place),)

    tick = timer('tick', reads=locked(29, False), writes=locked(30, True))
    other = subscription('on_set', 'other', writes=locked(35, True))
    assert races(unit(threads(2), tick, other)) == []


def test_one_finding_for_one_attribute() -> None:
    groups = tuple(exclusive(name) for name in 'abc')
    callbacks = [
        timer(f'on_{name}', name, writes=updates('Arm.count', 30 + i))
        for i, name in enumerate('abc')
    ]
    spec = unit(threads(4), *callbacks, groups=groups)
    finding = only(spec, 'CC301')
    assert finding.place == at(30)
    assert finding.subjects == ('Arm.count', 'on_a', 'on_b', 'on_c')


def test_others_are_those_that_disturb_the_first() -> None:
    """``tick`` and ``reset`` hold one lock, ``peek`` holds none."""
    tick = timer('tick', 'a', writes=updates('Arm.n', 30, 'lock'))
    reset = subscription('reset', 'b', writes=writes('Arm.n', 35, 'lock'))
    peek = subscription('peek', 'c', writes=writes('Arm.n', 37))
    groups = tuple(exclusive(name) for name in 'abc')
    spec = unit(threads(4), tick, reset, peek, groups=groups)
    assert only(spec, 'CC301').subjects == ('Arm.n', 'tick', 'peek')


def test_one_function_of_two_entities() -> None:
    one = subscription('on_left', 'a', function='Arm.on_joint', writes=writes('Arm.joint', 30))
    other = subscription('on_right', 'b', function='Arm.on_joint', writes=writes('Arm.joint', 30))
    spec = unit(threads(2), one, other, groups=(exclusive('a'), exclusive('b')))
    assert only(spec, 'CC302').message == (
        'on_joint and on_joint of another entity may write Arm.joint at the same time: the last '
        'one wins'
    )


def test_attributes_of_the_same_callbacks_are_one_finding() -> None:
    tick = timer('tick', writes=(*updates('Arm.b', 31), *updates('Arm.a', 30)))
    reset = subscription('reset', 'other', writes=(*writes('Arm.a', 35), *writes('Arm.b', 36)))
    finding = only(unit(threads(2), tick, reset), 'CC301')
    assert finding.subjects == ('Arm.a', 'Arm.b', 'tick', 'reset')
    assert finding.message == (
        'tick updates Arm.a, Arm.b from their old values, and reset may write them at the same '
        'time: one change can get lost'
    )


def test_one_function_of_several_entities_is_named_once() -> None:
    tick = timer('tick', writes=updates('Arm.a', 30))
    done = [
        outside(name, EntityKind.DONE_CALLBACK, function='Arm.on_done', writes=writes('Arm.a', 35))
        for name in ('plan_on_done', 'home_on_done')
    ]
    finding = only(unit(threads(2), tick, *done), 'CC303')
    assert [remark.text for remark in finding.related] == ['on_done writes Arm.a here']


def test_several_that_write_at_one_line_are_shown_there_once() -> None:
    tick = timer('tick', writes=updates('Arm.a', 30))
    done = [
        outside(name, EntityKind.DONE_CALLBACK, writes=writes('Arm.a', 35))
        for name in ('on_plan', 'on_home')
    ]
    finding = only(unit(threads(2), tick, *done), 'CC303')
    assert [remark.text for remark in finding.related] == ['on_plan, on_home write Arm.a here']


def test_an_update_that_others_lose_too_is_one_finding() -> None:
    count = updates('Arm.n', 30)
    image, scan = (subscription(name, 'free', writes=count) for name in ('image', 'scan'))
    assert races(unit(threads(2), image, scan)) == ['CC301:30 warning']
    reset = timer('reset', writes=writes('Arm.n', 40))
    assert races(unit(threads(2), image, reset)) == ['CC301:30 warning']
    assert races(unit(threads(2), image)) == ['CC304:30 warning']


def test_one_lock_mends_a_chain_of_done_callbacks_which_is_one_finding() -> None:
    steps = [
        outside(f'on_step_{n}', EntityKind.DONE_CALLBACK, writes=updates('Arm.step', 30 + n))
        for n in range(4)
    ]
    alone = outside('on_stop', EntityKind.DONE_CALLBACK, writes=updates('Arm.stops', 50))
    several = unit(threads(2), *steps, alone)
    assert races(several) == ['CC303:30 warning', 'CC304:50 warning']
    told = {remark.text for remark in only(several, 'CC303').related}
    assert told == {f'on_step_{n} writes Arm.step here' for n in (1, 2, 3)}


def test_work_outside_every_group_overlaps_the_exclusive_group_too() -> None:
    done = outside('on_done', EntityKind.DONE_CALLBACK, writes=updates('Arm.pending', 40))
    tick = timer('tick', writes=updates('Arm.pending', 30))
    assert races(unit(threads(2), tick, done)) == ['CC303:30 warning']
    assert races(unit(ONE_THREAD, tick, done)) == []
    message = only(unit(threads(2), tick, done), 'CC303').message
    assert message.endswith('on_done is a done-callback and runs outside every callback group')


@pytest.mark.parametrize(
    ('callback', 'expected'),
    [
        (subscription('f', 'free', writes=updates('Arm.n', 30)), ['CC304:30 warning']),
        (subscription('f', 'free', writes=updates('Arm.n', 30, 'Arm.lock')), []),
        (subscription('f', 'free', writes=writes('Arm.n', 30)), []),
        (subscription('f', 'other', writes=updates('Arm.n', 30)), []),
        (timer('f', 'free', writes=updates('Arm.n', 30)), ['CC304:30 note']),
        (
            timer('f', 'free', writes=updates('Arm.n', 30), blocking=calls(None)),
            ['CC304:30 warning'],
        ),
        (timer('f', 'free', writes=updates('Arm.n', 30), one_shot=True), []),
    ],
)
def test_a_callback_that_overlaps_itself(callback: Callback, expected: list[str]) -> None:
    assert races(unit(threads(2), callback)) == expected


def test_a_race_is_a_warning_and_not_an_error() -> None:
    assert only(counter(threads(2)), 'CC301').severity is Severity.WARNING


def test_the_help_names_no_group_for_what_is_in_none() -> None:
    done = outside('on_done', EntityKind.DONE_CALLBACK, writes=writes('Arm.goal', 40))
    tick = timer('tick', writes=writes('Arm.goal', 30))
    help_text = 'hold one lock around both; a callback group cannot help'
    assert only(unit(threads(2), tick, done), 'CC302').help == help_text
    tock = timer('tock', 'other', writes=writes('Arm.goal', 35))
    assert 'one mutually exclusive group' in only(unit(threads(2), tick, tock), 'CC302').help


@pytest.mark.parametrize(
    ('collection', 'expected'),
    [('dict', ['CC301:30 warning']), ('set', ['CC301:30 warning']), ('list', [])],
)
def test_a_collection_that_changes_while_another_callback_goes_over_it(
    collection: str, expected: list[str]
) -> None:
    def loop(*locks: str) -> Callback:
        place = Place(FILE, 30)
        read = Access(name='Arm.table', source=place, iterates=collection, locks=locks)
        return timer('tick', reads=(read,))

    other = subscription('on_set', 'other', writes=appends('Arm.table', 35))
    assert races(unit(threads(2), loop(), other)) == expected
    assert races(unit(threads(2), other, loop())) == expected
    locked = replace(appends('Arm.table', 35)[0], locks=('lock',))
    other = subscription('on_set', 'other', writes=(locked,))
    assert races(unit(threads(2), loop('lock'), other)) == []
    assert races(unit(threads(1), loop(), other)) == []
    elsewhere = subscription('on_set', 'other', writes=appends('Arm.list', 35))
    assert races(unit(threads(2), loop(), elsewhere)) == []
    assigned = subscription('on_set', 'other', writes=writes('Arm.table', 35))
    assert races(unit(threads(2), loop(), assigned)) == []
    same = replace(appends('Arm.table', 35)[0], keeps_size=True)
    other = subscription('on_set', 'other', writes=(same,))
    assert races(unit(threads(2), loop(), other)) == []


@pytest.mark.parametrize(
    ('transition', 'written', 'expected'),
    [
        ('on_configure', 8, []),
        ('on_configure', 10, ['CC301:30 warning']),
        ('on_activate', 8, ['CC301:30 warning']),
    ],
)
def test_what_a_transition_does_before_it_makes_a_callback_comes_first(
    transition: str, written: int, expected: list[str]
) -> None:
    made = (Act(name='timer', source=at(9)),) if transition == 'on_configure' else ()
    spec = unit(
        threads(2),
        timer('tick', writes=updates('Arm.count', 30), source=at(9), when=When.CONFIGURE),
        callback(
            transition,
            EntityKind.LIFECYCLE_SERVICE,
            'other',
            writes=writes('Arm.count', written),
            changes=made,
        ),
    )
    assert races(spec) == expected


CLAIM = """
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Empty

class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.first = None
        self.create_subscription(Empty, 'in', self.on_msg, 10)
        self.create_timer(1.0, self.reset, callback_group=MutuallyExclusiveCallbackGroup())

    def on_msg(self, msg):
        {test}
            self.first = {stored}

    def reset(self):
        {write}

rclpy.init()
executor = MultiThreadedExecutor(num_threads=2)
executor.add_node(Arm())
executor.spin()
"""


@pytest.mark.parametrize(
    ('test', 'write', 'expected'),
    [
        ('if self.first is None:', 'self.first = None', []),
        ('if not self.first:', 'self.first = None', []),
        ('if not self.first:', 'self.first = False', []),
        ('if self.first is None:', 'self.first = False', ['CC301:17 warning']),
        ('if self.first is None:', 'self.first = 1', ['CC301:17 warning']),
        ('if self.first is not None:', 'self.first = None', ['CC301:17 warning']),
        ('if self.first is None or msg:', 'self.first = None', ['CC301:17 warning']),
        ('if self.first is None:', 'self.first = None; self.first = 1', ['CC301:17 warning']),
    ],
)
def test_a_write_of_what_a_test_has_found_is_no_disturbance(
    test: str, write: str, expected: list[str], tmp_path: Path
) -> None:
    assert races_of_claim(test, 'msg', write, tmp_path) == expected


@pytest.mark.parametrize(
    ('test', 'stored', 'write', 'expected'),
    [
        ('if self.first:', 'None', 'self.first = None', ['CC301:17 warning']),
        ('if msg:', 'None', 'self.first = None', []),
        ('if self.first:', 'False', 'self.first = False', []),
        ('if msg:', 'False', 'self.first = False', []),
        ('if self.first:', 'False', 'self.first = True', ['CC301:17 warning']),
        ('if msg:', 'False', 'self.first = True', ['CC302:20 note']),
        ('if msg:', 'False', 'self.first = None', ['CC302:20 note']),
        ('if self.first:', 'None', 'if self.first: self.first = None', ['CC301:20 warning']),
    ],
)
def test_who_is_last_is_no_matter_where_both_store_the_same(
    test: str, stored: str, write: str, expected: list[str], tmp_path: Path
) -> None:
    assert races_of_claim(test, stored, write, tmp_path) == expected


def races_of_claim(test: str, stored: str, write: str, folder: Path) -> list[str]:
    path = folder / 'arm.py'
    path.write_text(CLAIM.format(test=test, stored=stored, write=write), encoding='utf-8')
    (spec,) = scan([path], root=folder).units
    return races(spec)
