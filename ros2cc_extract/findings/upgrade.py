"""What changes for a program when another release of rclpy runs it, and why."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from enum import Enum

from ros2cc_extract.findings.base.model import Finding
from ros2cc_extract.findings.rules.registry import BY_CODE
from ros2cc_extract.findings.waits.workers import EVENTS, MULTI, SINGLE
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.assumptions import DEFAULT_COUNT
from ros2cc_extract.spec.effects import Blocking
from ros2cc_extract.spec.late_spins import late_spins
from ros2cc_extract.spec.model import Activity, Callback, EntityKind, Spec
from ros2cc_extract.spec.releases.behaviour import Behaviour
from ros2cc_extract.spec.releases.table import (
    CALL_TAKES_TIMEOUT,
    CALL_TIMEOUT_RAISES,
    COROUTINES_IN_EVENTS,
    EVENTS_EXECUTOR,
    EXCEPTION_AFTER_AWAIT_LOST,
    FUTURE_YIELDS_ITSELF,
    MESSAGE_INFO,
    NODE_STAYS,
    SPIN_REFUSED_TWICE,
    SPIN_YIELDS,
    TASKS_OLDEST_FIRST,
    THREADS_BY_AFFINITY,
    TIMEOUT_KEEPS_HARVEST,
    TIMER_INFO,
    UNTIL_ASKS_FUTURE,
)


class Turn(Enum):
    """What becomes of a finding."""

    COMES = 'comes'
    GOES = 'goes'
    CHANGES = 'changes'
    BEHAVES = 'behaves otherwise'


@dataclass(frozen=True, kw_only=True)
class Change:
    """
    One change.

    :param code: of the finding that comes or goes; empty where only the behaviour differs.
    :param because: the switches that may be the reason; those that differ, of what it rests on.
    """

    turn: Turn
    place: Place
    code: str
    message: str
    because: tuple[Behaviour, ...]


_OF_MODELS = (TASKS_OLDEST_FIRST, FUTURE_YIELDS_ITSELF, SPIN_REFUSED_TWICE, NODE_STAYS)
_OF_RULES: Mapping[str, tuple[Behaviour, ...]] = {
    'CC106': (NODE_STAYS, SPIN_REFUSED_TWICE),
    'CC107': (SPIN_REFUSED_TWICE,),
    'CC113': (COROUTINES_IN_EVENTS,),
    'CC124': (MESSAGE_INFO,),
    'CC126': (TIMER_INFO,),
    'CC206': (TIMEOUT_KEEPS_HARVEST,),
}
_ABOUT_US = frozenset({'CC120', 'CC121', 'CC500', 'CC501', 'CC502'})
"""Rules about what this tool knows, and not about what the program does."""
_SAYS_BOTH = frozenset({'CC107'})
"""Rules whose message says what each release does, whichever is asked for."""


@dataclass(frozen=True)
class Felt:
    """Where a unit feels a row; ``only`` is under which condition, if that is open."""

    place: Place | None
    only: str = ''


Feels = Callable[[Spec], Iterator[Felt]]


def _calls_in_time(unit: Spec) -> Iterator[Felt]:
    yield from (Felt(block.source) for block in _timed_calls(unit))


def _calls_that_raise(unit: Spec) -> Iterator[Felt]:
    for block in _timed_calls(unit):
        if not block.caught:
            yield Felt(block.source, 'if nobody answers in time')


def _timed_calls(unit: Spec) -> Iterator[Blocking]:
    doers: tuple[Callback | Activity, ...] = (*unit.callbacks, *unit.activities)
    for doer in doers:
        for block in doer.blocking:
            if block.call.rpartition('.')[2] == 'call' and block.seconds is not None:
                yield block


def _events(unit: Spec) -> Iterator[Felt]:
    """Not where another executor takes its place if it cannot be imported."""
    if unit.executor.kind == EVENTS and not unit.executor.import_caught:
        yield Felt(unit.executor.source)


def _awaits(unit: Spec) -> Iterator[Felt]:
    if unit.executor.kind == SINGLE:
        for callback in unit.callbacks:
            if any(block.suspends for block in callback.blocking):
                place = callback.defined or callback.source
                yield Felt(place, f'if {callback.display_name} raises there')


def _woken_by_threads(unit: Spec) -> Iterator[Felt]:
    if unit.executor.kind in (SINGLE, MULTI):
        for block in (block for callback in unit.callbacks for block in callback.blocking):
            if block.suspends and block.foreign and block.seconds is None:
                yield Felt(block.source, 'if a thread completes it')


def _spun_until(unit: Spec) -> Iterator[Felt]:
    for block in late_spins(unit):
        yield Felt(block.source, 'if a thread completes it')


def _several_tasks(unit: Spec) -> Iterator[Felt]:
    """A callback that makes more than one task has them run in an order."""
    if unit.executor.kind not in (SINGLE, MULTI):
        return
    tasks = {each.source for each in unit.callbacks if each.entity is EntityKind.TASK}
    for callback in unit.callbacks:
        made = [act for act in callback.changes if act.source in tasks]
        if len(made) > 1 or any(act.repeats for act in made):
            yield Felt(made[-1].source)


def _default_threads(unit: Spec) -> Iterator[Felt]:
    if unit.executor.threads_source == DEFAULT_COUNT:
        yield Felt(unit.executor.source, 'if the process may not use all CPUs')


def _pool(unit: Spec) -> Iterator[Felt]:
    if unit.executor.kind == MULTI:
        yield Felt(unit.executor.source)


_FEELS: tuple[tuple[Behaviour, Feels], ...] = (
    (TASKS_OLDEST_FIRST, _several_tasks),
    (FUTURE_YIELDS_ITSELF, _woken_by_threads),
    (UNTIL_ASKS_FUTURE, _spun_until),
    (EVENTS_EXECUTOR, _events),
    (CALL_TAKES_TIMEOUT, _calls_in_time),
    (CALL_TIMEOUT_RAISES, _calls_that_raise),
    (EXCEPTION_AFTER_AWAIT_LOST, _awaits),
    (THREADS_BY_AFFINITY, _default_threads),
    (SPIN_YIELDS, _pool),
)
"""Rows that no verdict rests on, and the code that they affect."""
_OF_IDLE = ((UNTIL_ASKS_FUTURE, _spun_until),)
_ONCE = frozenset({SPIN_YIELDS})
"""Rows that are listed at one place of a program, since all its pools feel them alike."""
_NEEDS = {CALL_TIMEOUT_RAISES: CALL_TAKES_TIMEOUT, COROUTINES_IN_EVENTS: EVENTS_EXECUTOR}
"""Rows about something that releases without another row do not have at all."""


@dataclass(frozen=True, kw_only=True)
class Side:
    """
    What one release does to the units.

    :param undecided: names of the units that a limit left partly open.
    """

    release: str
    findings: Sequence[Finding]
    undecided: frozenset[str] = frozenset()


def changes(
    units: Iterable[Spec], old: Side, new: Side, idle: Iterable[Spec] = ()
) -> tuple[Change, ...]:
    """
    List what changes from one release to another; by place.

    :param idle: units without any callback: it is only looked at how long they are spun.
    """
    releases = old.release, new.release
    of_idle = _of_behaviour(idle, _OF_IDLE, *releases)
    found = [*_of_findings(old, new), *_of_behaviour(units, _FEELS, *releases), *of_idle]
    return tuple(
        sorted(dict.fromkeys(found), key=lambda each: (each.place, each.code, each.message))
    )


def not_compared(old: Side, new: Side) -> frozenset[str]:
    """Names of the units of which a side left something open: what changes there is not known."""
    return old.undecided | new.undecided


Pair = tuple[Finding | None, Finding | None]


def _pairs(old: Side, new: Side) -> list[Pair]:
    was, will = _by_identity(old.findings), _by_identity(new.findings)
    return [(was.get(each), will.get(each)) for each in {**was, **will}]


def _of_findings(old: Side, new: Side) -> Iterator[Change]:
    releases = old.release, new.release
    for left, right in _pairs(old, new):
        if right is None and left is not None:
            if not _is_open(left, new):
                yield _change(Turn.GOES, left, left.message, *releases)
        elif left is None and right is not None:
            if not _is_open(right, old):
                yield _change(Turn.COMES, right, right.message, *releases)
        elif left is not None and right is not None and _differ(left, right, *releases):
            yield _change(Turn.CHANGES, right, right.message, *releases)


def _by_identity(findings: Iterable[Finding]) -> dict[object, Finding]:
    return {(f.code, f.place, f.unit, f.subjects): f for f in findings if f.code not in _ABOUT_US}


def _is_open(finding: Finding, lacking: Side) -> bool:
    """Whether the side that lacks a finding might have it, had it been decided."""
    return finding.unit in lacking.undecided


def _differ(left: Finding, right: Finding, old: str, new: str) -> bool:
    """Whether a finding says something else, or all that it may say and other releases do."""
    if (left.message, left.severity) != (right.message, right.severity):
        return True
    return left.code in _SAYS_BOTH and bool(_differing(left, old, new))


def _change(turn: Turn, finding: Finding, message: str, old: str, new: str) -> Change:
    rows = _differing(finding, old, new)
    return Change(turn=turn, place=finding.place, code=finding.code, message=message, because=rows)


def _differing(finding: Finding, old: str, new: str) -> tuple[Behaviour, ...]:
    return tuple(row for row in _rows_of(finding.code) if row.differs(old, new))


def _rows_of(code: str) -> tuple[Behaviour, ...]:
    rule = BY_CODE[code]
    of_diagnostics = rule.since or rule.until
    return (of_diagnostics,) if of_diagnostics else _OF_RULES.get(code, _OF_MODELS)


def _of_behaviour(
    units: Iterable[Spec], felt_by: Sequence[tuple[Behaviour, Feels]], old: str, new: str
) -> Iterator[Change]:
    rows = [(row, feels) for row, feels in felt_by if _changes(row, old, new)]
    listed = set()
    for unit in units:
        for row, feels in rows:
            for felt in feels(unit):
                if row not in listed:
                    yield _behaves(row, felt, unit, old, new)
                listed |= {row} & _ONCE


def _changes(row: Behaviour, old: str, new: str) -> bool:
    needed = _NEEDS.get(row)
    return row.differs(old, new) and (needed is None or not needed.differs(old, new))


def _behaves(row: Behaviour, felt: Felt, unit: Spec, old: str, new: str) -> Change:
    only = f', {felt.only}' if felt.only else ''
    return Change(
        turn=Turn.BEHAVES,
        place=felt.place or Place(unit.name),
        code='',
        message=f'{row.concerns}{only}: before, {row.words_for(old)}; then, {row.words_for(new)}',
        because=(row,),
    )
