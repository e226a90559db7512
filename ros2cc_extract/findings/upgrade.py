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
from ros2cc_extract.spec.model import Spec
from ros2cc_extract.spec.releases.behaviour import Behaviour
from ros2cc_extract.spec.releases.table import (
    CALL_TAKES_TIMEOUT,
    CALL_TIMEOUT_RAISES,
    COROUTINES_IN_EVENTS,
    EVENTS_EXECUTOR,
    EXCEPTION_AFTER_AWAIT_LOST,
    FUTURE_YIELDS_ITSELF,
    NODE_STAYS,
    SPIN_REFUSED_TWICE,
    SPIN_YIELDS,
    TASKS_OLDEST_FIRST,
    THREADS_BY_AFFINITY,
    TIMEOUT_KEEPS_HARVEST,
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
    'CC206': (TIMEOUT_KEEPS_HARVEST,),
}


Felt = Callable[[Spec], Iterator[Place | None]]


def _calls_in_time(unit: Spec) -> Iterator[Place | None]:
    for callback in unit.callbacks:
        for block in callback.blocking:
            if block.call.rpartition('.')[2] == 'call' and block.seconds is not None:
                yield block.source


def _events(unit: Spec) -> Iterator[Place | None]:
    if unit.executor.kind == EVENTS:
        yield unit.executor.source


def _awaits(unit: Spec) -> Iterator[Place | None]:
    if unit.executor.kind == SINGLE:
        for callback in unit.callbacks:
            if any(block.suspends for block in callback.blocking):
                yield callback.defined or callback.source


def _default_threads(unit: Spec) -> Iterator[Place | None]:
    if unit.executor.threads_source == DEFAULT_COUNT:
        yield unit.executor.source


def _pool(unit: Spec) -> Iterator[Place | None]:
    if unit.executor.kind == MULTI:
        yield unit.executor.source


_FELT: tuple[tuple[Behaviour, Felt], ...] = (
    (EVENTS_EXECUTOR, _events),
    (CALL_TAKES_TIMEOUT, _calls_in_time),
    (CALL_TIMEOUT_RAISES, _calls_in_time),
    (EXCEPTION_AFTER_AWAIT_LOST, _awaits),
    (THREADS_BY_AFFINITY, _default_threads),
    (SPIN_YIELDS, _pool),
)
"""Rows that no verdict rests on, and who feels them."""


def changes(
    units: Iterable[Spec],
    before: Sequence[Finding],
    after: Sequence[Finding],
    old: str,
    new: str,
) -> tuple[Change, ...]:
    """List what changes from release ``old``, with its findings, to ``new``; by place."""
    found = [*_of_findings(before, after, old, new), *_of_behaviour(units, old, new)]
    return tuple(
        sorted(dict.fromkeys(found), key=lambda each: (each.place, each.code, each.message))
    )


def _of_findings(
    before: Sequence[Finding], after: Sequence[Finding], old: str, new: str
) -> Iterator[Change]:
    was, will = _by_identity(before), _by_identity(after)
    for identity in {**was, **will}:
        left, right = was.get(identity), will.get(identity)
        if right is None and left is not None:
            yield _change(Turn.GOES, left, left.message, old, new)
        elif left is None and right is not None:
            yield _change(Turn.COMES, right, right.message, old, new)
        elif left is not None and right is not None and _said(left) != _said(right):
            yield _change(Turn.CHANGES, right, right.message, old, new)


def _by_identity(findings: Iterable[Finding]) -> dict[object, Finding]:
    return {(f.code, f.place, f.unit, f.subjects): f for f in findings}


def _said(finding: Finding) -> object:
    return finding.message, finding.severity


def _change(turn: Turn, finding: Finding, message: str, old: str, new: str) -> Change:
    rows = tuple(row for row in _rows_of(finding.code) if row.differs(old, new))
    return Change(turn=turn, place=finding.place, code=finding.code, message=message, because=rows)


def _rows_of(code: str) -> tuple[Behaviour, ...]:
    rule = BY_CODE[code]
    of_diagnostics = rule.since or rule.until
    return (of_diagnostics,) if of_diagnostics else _OF_RULES.get(code, _OF_MODELS)


def _of_behaviour(units: Iterable[Spec], old: str, new: str) -> Iterator[Change]:
    rows = [(row, felt) for row, felt in _FELT if row.differs(old, new)]
    for unit in units:
        for row, felt in rows:
            message = f'{row.concerns}: before, {row.told(old)}; then, {row.told(new)}'
            for place in felt(unit):
                yield Change(
                    turn=Turn.BEHAVES,
                    place=place or Place(unit.name),
                    code='',
                    message=message,
                    because=(row,),
                )
