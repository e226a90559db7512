"""Drift of one specification against another, where no source can show it."""

from __future__ import annotations

from dataclasses import replace

from ros2cc_extract.compare.drift import Drift, drift
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.effects import Access, Blocking
from ros2cc_extract.spec.model import (
    Callback,
    CallbackGroup,
    CallbackType,
    Executor,
    GroupType,
    Spec,
    Unresolved,
)

FIRST, SECOND = (
    Callback(name=name, type=CallbackType.SUB, group='g', source=Place('arm.py', line, 9))
    for name, line in (('first', 10), ('second', 11))
)
UNIT = Spec(
    name='arm',
    callbacks=(FIRST, SECOND),
    groups=(CallbackGroup(name='g', type=GroupType.EXCLUSIVE),),
    executor=Executor(name='executor', threads=('t0',), threads_source='arm.py:20'),
)


def test_a_unit_does_not_drift_from_itself() -> None:
    assert drift([UNIT], [UNIT]) == ()


def test_order_of_creation_counts() -> None:
    turned = replace(UNIT, callbacks=(SECOND, FIRST))
    change = 'order of creation was first, second, is second, first'
    assert drift([UNIT], [turned]) == (Drift('arm', 'callbacks', change, SECOND.source),)


def test_where_a_thread_count_stands_does_not_count() -> None:
    moved = replace(UNIT, executor=replace(UNIT.executor, threads_source='arm.py:99'))
    assert drift([UNIT], [moved]) == ()


def test_what_a_callback_does_is_told_entry_by_entry() -> None:
    waits = Blocking(call='client.call', on='map', seconds=2.0, source=Place('arm.py', 30))
    writes = Access(name='Arm.n', locks=('Arm.lock',), update=True, in_place=True)
    now = replace(UNIT, callbacks=(replace(FIRST, blocking=(waits,), writes=(writes,)), SECOND))
    told = [each.change for each in drift([UNIT], [now])]
    assert told == [
        'now waits in client.call on map for 2.0 s',
        'now writes Arm.n as an update in one piece under Arm.lock',
    ]
    assert [each.change for each in drift([now], [UNIT])] == [
        text.replace('now', 'no longer') for text in told
    ]


def test_a_fact_that_is_not_known_any_more_is_drift_once() -> None:
    hole = Unknown('the topic is a parameter', Place('arm.py', 5))
    now = replace(
        UNIT,
        callbacks=(replace(FIRST, key=hole), SECOND),
        unresolved=(Unresolved(subject='first', fact='key', reason=hole.reason),),
    )
    change = 'key was none, is unknown (the topic is a parameter)'
    assert drift([UNIT], [now]) == (Drift('arm', 'callback first', change, FIRST.source),)


def test_what_is_unresolved_outside_the_unit_is_told_too() -> None:
    hole = Unresolved(subject='tools.Base', fact='base', reason='not found')
    now = replace(UNIT, unresolved=(hole,))
    assert drift([UNIT], [now]) == (
        Drift('arm', 'tools.Base', 'base is not known any more: not found'),
    )
    assert drift([now], [UNIT]) == (Drift('arm', 'tools.Base', 'base is known now'),)
