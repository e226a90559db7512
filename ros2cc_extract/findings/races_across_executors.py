"""Races over objects that callbacks of several executors of one program share."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import combinations

from ros2cc_extract.findings.base.model import Finding
from ros2cc_extract.findings.base.rule import Context, Doer, Hit
from ros2cc_extract.findings.races.flag_locks import shared_of_each
from ros2cc_extract.findings.races.races import Race, RaceKind, races_across
from ros2cc_extract.findings.races.shared_objects import node_classes, shared_part
from ros2cc_extract.findings.rules.races import cleared_in_use, lost_update, unordered_write
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.model import Callback, Spec

_ADDED = '; their executors run at the same time, each in a thread of its own'


def findings_across(units: Sequence[Spec]) -> tuple[Finding, ...]:
    """What no unit alone shows: one finding for each attribute and those that change it."""
    by_entry: dict[str, list[Spec]] = {}
    for unit in units:
        if unit.entry is not None:
            by_entry.setdefault(unit.entry, []).append(unit)
    return tuple(found for own in by_entry.values() for found in _of_program(own))


def _of_program(units: Sequence[Spec]) -> Iterator[Finding]:
    pairs = [pair for pair in combinations(units, 2) if _run_together(*pair)]
    if not pairs:
        return
    classes = node_classes(units)
    shared = shared_of_each([Context(unit) for unit in units])
    parts = {
        unit.name: tuple(_parts(callbacks, classes))
        for unit, callbacks in zip(units, shared, strict=True)
    }
    doers = (
        (one, other)
        for first, second in pairs
        for one in parts[first.name]
        for other in parts[second.name]
    )
    for race in races_across(doers):
        yield from _finding(race, units[0])


def _parts(callbacks: Sequence[Callback], classes: frozenset[str] | None) -> Iterator[Doer]:
    for callback in callbacks:
        part = shared_part(callback, classes)
        if part.writes or part.pieces or part.reads:
            yield part


def _run_together(one: Spec, other: Spec) -> bool:
    """Whether both are spun, one in a thread beside the other, and not in different branches."""
    executors = one.executor, other.executor
    is_known = all(
        each.unresolved is None and not isinstance(each.kind, Unknown) for each in executors
    )
    is_spun = all(each.spun is not None for each in executors)
    mark = one.executor.alternative
    is_either = mark is not None and mark == other.executor.alternative
    return is_known and is_spun and not is_either and any(each.in_thread for each in executors)


def _finding(race: Race, unit: Spec) -> Iterator[Finding]:
    hit: Hit = lost_update.hit_of(race, _ADDED, lost_update.HELP_OUTSIDE_GROUPS)
    rule = lost_update.RULE
    if race.kind is RaceKind.LAST_WRITE_WINS:
        rule = unordered_write.RULE
    elif race.kind is RaceKind.CLEARED_IN_USE:
        rule, hit = cleared_in_use.RULE, cleared_in_use.weighed(race, hit)
    yield from replace(rule, find=lambda _: iter((hit,))).check(Context(unit))
