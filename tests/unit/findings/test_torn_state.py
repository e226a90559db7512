"""Attributes that belong together, read while half of them are written."""

from __future__ import annotations

from dataclasses import replace

import pytest
from finding_units import (
    at,
    exclusive,
    found,
    only,
    sleeps,
    subscription,
    threads,
    timer,
    unit,
)

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.spec.effects import Access, Act, Blocking
from ros2cc_extract.spec.model import Callback

GROUPS = (exclusive('left'), exclusive('right'))


def reads(*locks: str, held: int = 1) -> Callback:
    """A timer that reads both, in one hold of its locks or in two."""
    accesses = tuple(
        Access(name=name, source=at(line), locks=locks)
        for name, line in (('Arm.x', 30), ('Arm.y', 33))
    )
    acts = tuple(Act(name=lock, source=at(29 + 2 * k)) for lock in locks for k in range(held))
    return timer('control', 'left', reads=accesses, locks=acts)


def stores(*locks: str, blocking: tuple[Blocking, ...] = (), akin: bool = False) -> Callback:
    first = Access(name='Arm.x', source=at(20), locks=locks)
    last = Access(name='Arm.y', source=at(22), locks=locks, joins='Arm.x', akin=akin)
    acts = tuple(Act(name=lock, source=at(19)) for lock in locks)
    return subscription('on_odom', 'right', writes=(first, last), locks=acts, blocking=blocking)


def codes(*callbacks: Callback, number: int = 4) -> list[str]:
    made = unit(threads(number), *callbacks, groups=GROUPS)
    return [code for code in found(made) if code.startswith('CC3')]


def test_the_finding_names_both_attributes_and_places() -> None:
    finding = only(unit(threads(4), reads(), stores(), groups=GROUPS), 'CC301')
    assert finding.message == (
        'control reads Arm.x, Arm.y, and on_odom may have written only some of them by then: '
        'new values stand beside old ones'
    )
    assert (finding.severity, finding.place.line) == (Severity.NOTE, 30)
    assert [remark.place.line for remark in finding.related] == [20, 22]


@pytest.mark.parametrize('akin', [True, False])
def test_it_is_a_warning_where_the_writer_waits_between_two_values_of_one_thing(
    akin: bool,
) -> None:
    waiting = stores(blocking=sleeps(0.1, line=21), akin=akin)
    finding = only(unit(threads(4), reads(), waiting, groups=GROUPS), 'CC301')
    assert finding.severity is (Severity.WARNING if akin else Severity.NOTE)


@pytest.mark.parametrize(
    ('reader', 'writer', 'is_torn'),
    [
        (reads('lock'), stores('lock'), False),
        (reads('lock', held=2), stores('lock'), True),
        (reads(), stores('lock'), True),
        (reads('one'), stores('other'), True),
    ],
)
def test_a_lock_over_both_writes_and_both_reads_keeps_them_whole(
    reader: Callback, writer: Callback, is_torn: bool
) -> None:
    assert bool(codes(reader, writer)) == is_torn


def test_on_one_thread_only_an_await_lets_others_see_half_of_it() -> None:
    awaiting = replace(stores(blocking=(Blocking(call='await', source=at(21)),)), coroutine=True)
    assert codes(reads(), stores(blocking=sleeps(0.1, line=21)), number=1) == []
    assert codes(reads(), awaiting, number=1) == ['CC301:30 note']


def test_who_reads_one_of_them_alone_is_not_warned() -> None:
    reader = reads()
    assert codes(replace(reader, reads=reader.reads[:1]), stores()) == []
