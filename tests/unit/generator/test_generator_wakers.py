"""
Waits of which the specification says who ends them, and claims that rest on what nobody knows.

Verdicts are of ``verify``: no, yes, or undecided with the reason.
"""

from __future__ import annotations

import pytest

from ros2cc_extract.checker.api import Verdict
from ros2cc_extract.generator.build import Profile
from ros2cc_extract.generator.unit import number_unit
from ros2cc_extract.spec.close import ClosedSpec, close
from ros2cc_extract.spec.effects import Blocking
from ros2cc_extract.spec.yaml.yaml_io import read_specs
from ros2cc_extract.verify.search.options import Options
from ros2cc_extract.verify.unit import verify_unit

SINGLE, MULTI, EVENTS = 'SingleThreadedExecutor', 'MultiThreadedExecutor', 'EventsExecutor'
OPTIONS = Options(profile=Profile.RCLPY, structural=False)


def unit(
    callbacks: str, *, threads: int = 4, kind: str = MULTI, activities: str = ''
) -> ClosedSpec:
    """A unit of lines ``name group: blocking``; groups whose names begin with f are reentrant."""
    rows, groups = [], []
    for line in callbacks.strip().splitlines():
        head, _, blocking = line.strip().partition(': ')
        name, group = head.split()
        groups.append(group)
        rows.append(
            f'{{name: {name}, type: {"CLT" if name == "client" else "TMR"}, '
            f'callback_group: {group}, node: arm, {blocking or "blocking: []"}}}'
        )
    types = {group: 'REENTRANT' if group.startswith('f') else 'EXCLUSIVE' for group in groups}
    text = f"""\
ros2cc: {{spec_version: 2}}
node:
  name: unit
  callbacks: [{', '.join(rows)}]
  callback_groups: [{', '.join(f'{{name: {g}, type: {t}}}' for g, t in types.items())}]
  executor:
    name: executor
    kind: {kind}
    threads: [{', '.join(f'{{name: t{n}}}' for n in range(threads))}]
  {activities}
"""
    (spec,) = read_specs(text, 'unit.yaml')
    return close(spec)


def said(closed: ClosedSpec) -> list[str]:
    """Who may not come to its end, or why that is not known; with ``deadlock`` for the unit."""
    found = []
    for result in verify_unit(closed, OPTIONS).results:
        name = ' '.join(result.callbacks) if result.family == 'progress' else 'deadlock'
        if result.family not in ('progress', 'deadlock') or result.verdict is Verdict.SATISFIED:
            continue
        undecided = result.verdict is Verdict.UNDECIDED
        found.append(f'{name}: {result.reason}' if undecided else name)
    return found


def wait(resource: str, *wakers: str, needs: str = 'once', more: str = '') -> str:
    given = ', '.join(f'{{{waker}}}' for waker in wakers)
    return f'{{call: Event.wait, resource: {resource}, wakers: [{given}], needs: {needs}{more}}}'


def blocking(*waits: str) -> str:
    return f'blocking: [{", ".join(waits)}]'


DONE = blocking(wait('done', 'by: tick'))


@pytest.mark.parametrize('kind', [SINGLE, EVENTS])
def test_on_one_thread_nobody_sets_an_event_that_is_waited_for(kind: str):
    assert said(unit(f'drive a: {DONE}\ntick b', kind=kind, threads=1)) == ['deadlock', 'drive']


@pytest.mark.parametrize(('group', 'stuck'), [('a', ['deadlock', 'drive']), ('b', [])])
def test_an_event_set_by_a_member_of_the_own_group_never_comes(group: str, stuck: list[str]):
    assert said(unit(f'drive a: {DONE}\ntick {group}')) == stuck


def test_one_of_several_wakers_is_enough_for_an_event():
    either = blocking(wait('done', 'by: tick', 'by: scan'))
    assert said(unit(f'drive a: {either}\ntick a\nscan b')) == []


def test_where_all_are_needed_one_that_cannot_run_is_missed():
    both = blocking(wait('met', 'by: tick', 'by: scan', needs='all'))
    assert said(unit(f'drive a: {both}\ntick a\nscan b')) == ['deadlock', 'drive']
    assert said(unit(f'drive a: {both}\ntick c\nscan b')) == []


def test_each_wait_uses_up_a_signal_and_whoever_gives_it_comes_again():
    item = blocking(wait('queue', 'by: tick', needs='each'))
    assert said(unit(f'drive a: {item}\nturn b: {item}\ntick c')) == []
    twice = blocking(
        wait('queue', 'by: tick', needs='each'), wait('queue', 'by: tick', needs='each')
    )
    assert said(unit(f'drive a: {twice}\ntick c')) == []


def test_a_signal_of_a_timer_that_runs_once_ends_one_wait():
    item = blocking(wait('queue', 'by: tick', needs='each'))
    assert said(unit(f'drive a: {item}\nturn b: {item}\ntick c: one_shot: true')) == [
        'deadlock',
        'drive',
        'turn',
    ]


@pytest.mark.parametrize(
    ('forgets', 'once', 'stuck'),
    [
        ('true', 'true', ['deadlock', 'drive']),
        ('true', 'false', []),
        ('false', 'true', ['deadlock', 'drive']),
        ('false', 'false', []),
    ],
)
def test_what_each_wait_uses_up_or_forgets_must_come_again(
    forgets: str, once: str, stuck: list[str]
):
    told = blocking(wait('cond', 'by: tick', needs='each', more=f', forgets: {forgets}'))
    assert said(unit(f'drive a: {told}\ntick c: one_shot: {once}')) == stuck


def test_a_thread_that_tells_once_may_come_before_the_wait():
    told = blocking(wait('cond', 'by: work, after: 0', needs='each', more=', forgets: true'))
    thread = 'activities: [{name: work, kind: thread}]'
    assert said(unit(f'drive a: {told}', activities=thread)) == ['deadlock', 'drive']


def test_a_semaphore_that_nobody_gives_back_may_have_been_used_up_by_earlier_runs():
    one = blocking(wait('room', needs='each', more=', initial: 1'))
    reason = 'it is not known whether Event.wait ends'
    assert said(unit(f'drive a: {one}')) == [f'deadlock: {reason}', f'drive: {reason}']


def test_a_semaphore_that_is_given_back_lets_everybody_through():
    def guarded(other: str) -> str:
        by = ('by: drive, after: 1', 'by: turn, after: 1')
        inside = wait('done', f'by: {other}')
        return blocking(wait('room', *by, needs='each', more=', initial: 1'), inside)

    assert said(unit(f'drive a: {guarded("tick")}\nturn b: {guarded("tick")}\ntick c')) == []


def crossing(order_of_a: str, order_of_b: str) -> ClosedSpec:
    """Two callbacks that set an event for the other and wait for the other's."""
    after = {'sets, waits': 0, 'waits, sets': 1}
    return unit(
        f'a ga: {blocking(wait("e2", f"by: b, after: {after[order_of_b]}"))}\n'
        f'b gb: {blocking(wait("e1", f"by: a, after: {after[order_of_a]}"))}'
    )


@pytest.mark.parametrize(
    ('of_a', 'of_b', 'stuck'),
    [
        ('sets, waits', 'waits, sets', []),
        ('waits, sets', 'sets, waits', []),
        ('sets, waits', 'sets, waits', []),
        ('waits, sets', 'waits, sets', ['deadlock', 'a', 'b']),
    ],
)
def test_two_waits_that_cross(of_a: str, of_b: str, stuck: list[str]):
    assert said(crossing(of_a, of_b)) == stuck


def test_a_wait_that_nobody_ends_is_for_ever():
    assert said(unit(f'drive a: {blocking(wait("done"))}')) == ['deadlock', 'drive']


@pytest.mark.parametrize(
    'waits',
    [
        wait('done', more=', seconds: 1.0'),
        wait('done', 'by: time'),
        wait('done', 'by: outside'),
        wait('done', more=', conditional: true, seconds: 1.0'),
    ],
)
def test_time_and_others_outside_end_a_wait(waits: str):
    assert said(unit(f'drive a: {blocking(waits)}')) == []


ESCAPES = wait('done', 'by: tick', more=', escapes: given to a library, source: arm.py:7')
NOT_KNOWN = 'it is not known whether Event.wait at arm.py:7 ends (given to a library)'


def test_a_wait_that_somebody_unknown_may_end_leaves_open_who_hangs_by_it():
    assert said(unit(f'drive a: {blocking(ESCAPES)}\ntick a')) == [
        f'deadlock: {NOT_KNOWN}',
        f'drive: {NOT_KNOWN}',
    ]


def test_it_leaves_nothing_open_where_a_known_waker_ends_it_in_any_case():
    assert said(unit(f'drive a: {blocking(ESCAPES)}\ntick b')) == []


def test_who_hangs_however_that_wait_ends_is_told():
    """The second wait is for a member of the own group."""
    waits = blocking(ESCAPES, wait('other', 'by: tick'))
    assert said(unit(f'drive a: {waits}\ntick a')) == ['deadlock', 'drive']


def test_who_ends_whatever_is_not_known_is_decided():
    """Somebody else's unknown wait is no reason to leave this one open."""
    waits = blocking(wait('other', 'by: scan'))
    assert said(unit(f'drive a: {blocking(ESCAPES)}\nturn b: {waits}\ntick a\nscan c')) == [
        f'deadlock: {NOT_KNOWN}',
        f'drive: {NOT_KNOWN}',
    ]


def test_a_waker_that_is_not_in_the_unit_is_not_known():
    (dead, drive) = said(unit(f'drive a: {blocking(wait("done", "by: stranger"))}'))
    assert (dead, drive) == (
        'deadlock: it is not known whether Event.wait ends',
        'drive: it is not known whether Event.wait ends',
    )


SILENT = 'it is not known whether tick always signals done at arm.py:9'


def test_a_signal_in_a_branch_leaves_open_what_needs_it():
    maybe = blocking(wait('done', 'by: tick, conditional: true, source: arm.py:9'))
    assert said(unit(f'drive a: {maybe}\ntick b')) == [f'deadlock: {SILENT}', f'drive: {SILENT}']


def test_two_branches_that_may_both_be_skipped_are_one_doubt():
    one = 'by: tick, conditional: true, source: arm.py:9'
    maybe = blocking(wait('done', one, one.replace('9', '12')))
    assert said(unit(f'drive a: {maybe}\ntick b')) == [
        f'deadlock: {SILENT} or arm.py:12',
        f'drive: {SILENT} or arm.py:12',
    ]


def test_a_hang_that_needs_no_skipped_branch_is_proven():
    maybe = blocking(wait('done', 'by: tick, conditional: true'))
    assert said(unit(f'drive a: {maybe}\ntick a')) == ['deadlock', 'drive']


def test_a_token_in_a_branch_that_is_once_not_taken_may_never_come():
    maybe = blocking(wait('done', 'by: tick, conditional: true, source: arm.py:9', needs='each'))
    assert said(unit(f'drive a: {maybe}\ntick b')) == [f'deadlock: {SILENT}', f'drive: {SILENT}']


LOCKED = ', held: [lock]'


def test_a_signal_that_needs_a_lock_held_over_the_wait_never_comes():
    held = blocking(wait('done', 'by: tick, held: [lock]', more=LOCKED))
    assert said(unit(f'drive a: {held}\ntick b')) == ['deadlock', 'drive', 'tick']


def test_a_lock_that_is_taken_at_an_unknown_place_leaves_it_open():
    held = blocking(wait('done', 'by: tick', more=LOCKED))
    reason = 'it is not known whether the wait for the lock lock ends'
    assert said(unit(f'drive a: {held}\ntick b: locks: [{{name: lock}}]')) == [
        f'deadlock: {reason}',
        f'drive: {reason}',
        f'tick: {reason}',
    ]


def test_a_branch_may_skip_a_wait():
    """Then what holds a lock afterwards meets others that the wait would have kept away."""
    waits = blocking(
        wait('first', 'by: tick', more=', conditional: true'), wait('second', 'by: scan')
    )
    assert said(unit(f'drive a: {waits}\ntick b\nscan a')) == ['deadlock', 'drive']


def test_an_awaited_future_that_another_callback_makes_done():
    awaits = DONE.replace('Event.wait', 'await')
    assert said(unit(f'drive a: {awaits}\ntick b', threads=1)) == []
    assert said(unit(f'drive a: {awaits}\ntick a')) == ['deadlock', 'drive']
    assert said(unit(f'drive a: {awaits}\ntick b', threads=1, kind=SINGLE)) == []


def test_the_run_names_who_signals():
    results = verify_unit(crossing('waits, sets', 'waits, sets'), OPTIONS).results
    (run,) = [r.evidence for r in results if r.family == 'progress' and r.callbacks == ('a',)]
    assert run is not None
    words = [sentence.text for moment in run.moments for sentence in moment.sentences]
    assert 'a waits on t0 for b' in words or 'a waits on t1 for b' in words


def beside(*activities: str) -> str:
    return f'activities: [{", ".join(f"{{{each}}}" for each in activities)}]'


FEEDER = 'name: feeder, kind: thread, loops: true'


def test_a_thread_sets_what_a_callback_waits_for():
    waits = blocking(wait('done', 'by: feeder'))
    for kind in (SINGLE, MULTI, EVENTS):
        closed = unit(f'drive a: {waits}', threads=1, kind=kind, activities=beside(FEEDER))
        assert said(closed) == []


def test_a_thread_feeds_a_queue_as_often_as_it_is_asked_for():
    item = wait('queue', 'by: feeder', needs='each')
    rows = f'drive a: {blocking(item, item)}\nturn b: {blocking(item)}'
    assert said(unit(rows, activities=beside(FEEDER))) == []
    once = 'name: feeder, kind: thread'
    assert said(unit(rows, activities=beside(once))) == ['deadlock', 'drive', 'turn']


def test_a_thread_that_a_callback_starts_cannot_end_a_wait_before_it_is_started():
    feeder = 'name: feeder, kind: thread, starts: [{by: turn, after: 0}]'
    waits = blocking(wait('done', 'by: feeder'))
    assert said(unit(f'drive a: {waits}\nturn b', activities=beside(feeder))) == []
    assert said(unit(f'drive a: {waits}\nturn a', activities=beside(feeder))) == [
        'deadlock',
        'drive',
    ]


@pytest.mark.parametrize(('group', 'stuck'), [('a', True), ('b', False)])
def test_a_join_on_a_thread_that_waits_for_a_callback(group: str, stuck: bool):
    """Who joins keeps its group closed, in which the callback is."""
    worker = 'name: worker, kind: thread, starts: [{by: drive, after: 0}], ' + blocking(
        wait('done', 'by: tick')
    )
    joins = blocking(wait('worker', 'by: worker').replace('Event.wait', 'Thread.join'))
    closed = unit(f'drive a: {joins}\ntick {group}', activities=beside(worker))
    assert said(closed) == (['deadlock', 'drive', 'worker'] if stuck else [])


@pytest.mark.parametrize(('call', 'stuck'), [('Thread.join', False), ('Event.wait', True)])
def test_what_nobody_has_started_cannot_be_joined(call: str, stuck: bool):
    """The starter may never run, or only after the join; an event is there without a thread."""
    worker = 'name: worker, kind: thread, starts: [{by: tick, after: 0}]'
    joins = blocking(wait('worker', 'by: worker').replace('Event.wait', call))
    closed = unit(f'drive a: {joins}\ntick a', activities=beside(worker))
    assert said(closed) == (['deadlock', 'drive'] if stuck else [])


def test_a_started_thread_that_never_ends_is_joined_in_vain():
    worker = 'name: worker, kind: thread, starts: [{by: tick, after: 0}], ' + blocking(
        wait('done', 'by: scan')
    )
    joins = blocking(wait('worker', 'by: worker').replace('Event.wait', 'Thread.join'))
    closed = unit(f'drive a: {joins}\ntick a\nscan a', activities=beside(worker))
    assert said(closed) == ['deadlock', 'drive', 'worker']


def test_a_thread_that_needs_a_lock_that_is_held_while_it_is_waited_for():
    worker = 'name: worker, kind: thread, node: arm, locks: [{name: lock}]'
    held = 'by: worker, after: 0, held: [lock]'
    waits = blocking(wait('done', held, more=LOCKED))
    assert said(unit(f'drive a: {waits}', activities=beside(worker))) == [
        'deadlock',
        'drive',
        'worker',
    ]


@pytest.mark.parametrize(('held', 'stuck'), [(LOCKED, True), ('', False)])
def test_a_thread_takes_its_locks_before_its_end(held: str, stuck: bool):
    """Whatever it waits for besides, the lock comes before what a join needs."""
    stops = wait('running', 'by: drive, after: 0')
    worker = f'name: worker, kind: thread, node: arm, locks: [{{name: lock}}], {blocking(stops)}'
    joins = wait('worker', 'by: worker', more=held).replace('Event.wait', 'Thread.join')
    closed = unit(f'drive a: {blocking(joins)}', activities=beside(worker))
    assert said(closed) == (['deadlock', 'drive', 'worker'] if stuck else [])


def test_a_thread_calls_a_service_of_a_group_that_is_held():
    calls = '{call: client.call, waits_for: client}'
    worker = f'name: worker, kind: thread, {blocking(calls)}'
    rows = 'drive a: ' + blocking(wait('done', 'by: worker')) + '\nclient a'
    closed = unit(rows, activities=beside(worker))
    assert said(closed) == ['deadlock', 'drive', 'worker']
    assert said(unit(rows.replace('client a', 'client b'), activities=beside(worker))) == []


def test_a_loop_that_waits_first_is_at_rest_there():
    item = wait('queue', 'by: tick, conditional: true', needs='each')
    worker = f'name: worker, kind: thread, loops: true, {blocking(item)}'
    assert said(unit('tick a', activities=beside(worker))) == []


def test_a_loop_for_which_nobody_works_waits_for_ever():
    worker = f'name: worker, kind: thread, loops: true, {blocking(wait("queue", needs="each"))}'
    assert said(unit('tick a', activities=beside(worker))) == ['deadlock', 'worker']


def test_of_a_thread_of_which_nothing_is_known_only_what_needs_it_is_open():
    worker = f'name: worker, kind: thread, {blocking("{call: input, source: arm.py:5}")}'
    waits = blocking(wait('fed', 'by: worker'))
    reason = 'it is not known whether input at arm.py:5 ends'
    closed = unit(f'drive a: {waits}\nturn b: {DONE}\ntick c', activities=beside(worker))
    assert said(closed) == [f'deadlock: {reason}', f'drive: {reason}']
    assert said(unit(f'turn b: {DONE}\ntick c', activities=beside(worker))) == []


def test_activities_are_no_workers():
    """Two threads beside a pool of one: a wait there holds up nothing."""
    waiting = [f'name: w{n}, kind: thread, {blocking(wait("done", "by: tick"))}' for n in range(2)]
    assert said(unit('tick a\nscan b', threads=1, activities=beside(*waiting))) == []


def test_waits_without_a_start_value_are_not_compared_with_all_others(
    monkeypatch: pytest.MonkeyPatch,
):
    """A unit of many waits is numbered in a second, and not in minutes."""
    waits = blocking(*(wait(f'done{n}', 'by: c0') for n in range(20)))
    closed = unit('\n'.join(f'c{n} f{n}: {waits}' for n in range(20)))
    compared = 0
    equal = Blocking.__eq__

    def counting(one: Blocking, other: object) -> bool:
        nonlocal compared
        compared += 1
        return equal(one, other)

    monkeypatch.setattr(Blocking, '__eq__', counting)
    number_unit(closed, 1)
    assert compared <= 20 * 20
