"""
Contract mode: differences between a program and the committed specification.

Everything counts that decides how callbacks behave; where in a file it stands does not, so that
edits which only move lines are no drift. Unlike ``merge.diff`` nothing is excused: both sides
come from the same scanner, so what differs was changed.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import fields
from enum import Enum
from typing import TypeVar

from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.effects import Access, Act, Blocking
from ros2cc_extract.spec.model import Callback, CallbackGroup, Executor, Spec

PLACES = frozenset({'source', 'defined', 'chain', 'threads_source'})
OF_A_RUN = frozenset({'measured', 'duration_s'})
WORDS: Mapping[str, str] = {
    'cls': 'class',
    'entity': 'kind of entity',
    'group': 'callback group',
    'period_s': 'period in seconds',
    'spun': 'way it is spun',
    'when': 'time of creation',
}
VERBS: Mapping[str, str] = {
    'blocking': 'waits in',
    'reads': 'reads',
    'writes': 'writes',
    'locks': 'takes the lock',
    'publishes': 'publishes',
    'changes': 'changes',
    'pieces': 'shares piece by piece',
}
"""The facts that are lists, each with the verb for one entry."""
Named = TypeVar('Named', Callback, CallbackGroup)


@dataclass(frozen=True)
class Drift:
    """
    One change against the committed specification.

    :param subject: what it is about: ``callback drive``, ``executor``.
    :param change: a clause about it: ``is new``, ``callback group was a, is b``.
    :param place: where the subject is made now; ``None`` when it is gone.
    """

    unit: str
    subject: str
    change: str
    place: Place | None = None


def drift(committed: Sequence[Spec], extracted: Sequence[Spec]) -> tuple[Drift, ...]:
    """List every change, in the order of ``extracted``; what is gone comes last."""
    before = {unit.name: unit for unit in committed}
    now = {unit.name: unit for unit in extracted}
    found: list[Drift] = []
    for name, unit in now.items():
        if name in before:
            found.extend(_of_unit(before[name], unit))
        else:
            found.append(Drift(name, 'unit', 'is new', unit.executor.source))
    found.extend(Drift(name, 'unit', 'is gone') for name in before if name not in now)
    return tuple(found)


def _of_unit(before: Spec, now: Spec) -> Iterator[Drift]:
    if before.nodes != now.nodes:
        change = _was_is('nodes', before.nodes, now.nodes)
        yield Drift(now.name, 'unit', change, now.executor.source)
    yield from _of_executor(now.name, before.executor, now.executor)
    yield from _of_named(now.name, 'group', before.groups, now.groups)
    yield from _of_named(now.name, 'callback', before.callbacks, now.callbacks)
    yield from _of_order(now.name, before.callbacks, now.callbacks)
    yield from _of_unresolved(before, now)


def _of_executor(unit: str, before: Executor, now: Executor) -> Iterator[Drift]:
    for change in _changes(before, now, left_out=PLACES | {'threads', 'assumed'}):
        yield Drift(unit, 'executor', change, now.source)
    if _threads(before) != _threads(now):
        change = _was_is('number of threads', _threads(before), _threads(now))
        yield Drift(unit, 'executor', change, now.source)


def _threads(executor: Executor) -> str:
    """The number that stands in the source, or the rule by which rclpy finds one."""
    rule = executor.threads_source or ''
    return rule if rule and not Place.parse(rule).line else str(len(executor.threads))


def _of_named(
    unit: str, kind: str, before: Sequence[Named], now: Sequence[Named]
) -> Iterator[Drift]:
    old = {each.name: each for each in before}
    for each in now:
        subject = f'{kind} {each.name}'
        if each.name not in old:
            yield Drift(unit, subject, 'is new', each.source)
            continue
        for change in _changes(old[each.name], each, left_out=PLACES | OF_A_RUN):
            yield Drift(unit, subject, change, each.source)
    names = [each.name for each in now]
    yield from (Drift(unit, f'{kind} {name}', 'is gone') for name in old if name not in names)


def _of_order(unit: str, before: Sequence[Callback], now: Sequence[Callback]) -> Iterator[Drift]:
    """Compare creation order: it decides which is served first, and so which starves."""
    old, new = ([each.name for each in side] for side in (before, now))
    kept_before = tuple(name for name in old if name in new)
    kept_now = tuple(name for name in new if name in old)
    if kept_before != kept_now:
        change = _was_is('order of creation', kept_before, kept_now)
        yield Drift(unit, 'callbacks', change, now[0].source)


def _changes(before: object, now: object, left_out: frozenset[str]) -> Iterator[str]:
    """Clauses about two values of one dataclass."""
    for field in fields(now):  # type: ignore[arg-type]  # the callers pass dataclasses
        if field.name in left_out:
            continue
        old, new = getattr(before, field.name), getattr(now, field.name)
        if field.name in VERBS:
            yield from _of_list(field.name, old, new)
        elif _shown(old) != _shown(new):
            yield _was_is(WORDS.get(field.name, field.name.replace('_', ' ')), old, new)


def _of_list(name: str, before: Sequence[object], now: Sequence[object]) -> Iterator[str]:
    old, new = (dict.fromkeys(_shown(each) for each in side) for side in (before, now))
    yield from (f'now {VERBS[name]} {each}' for each in new if each not in old)
    yield from (f'no longer {VERBS[name]} {each}' for each in old if each not in new)


def _of_unresolved(before: Spec, now: Spec) -> Iterator[Drift]:
    """What is unresolved elsewhere; callbacks, groups and the executor report their own facts."""
    old, new = (
        {(each.subject, each.fact): each for each in unit.unresolved} for unit in (before, now)
    )
    reported = {*before.names(), *now.names()}
    for (subject, fact), each in new.items():
        if (subject, fact) not in old and subject not in reported:
            yield Drift(
                now.name, subject, f'{fact} is not known any more: {each.reason}', each.source
            )
    for subject, fact in old:
        if (subject, fact) not in new and subject not in reported:
            yield Drift(now.name, subject, f'{fact} is known now')


def _was_is(fact: str, before: object, now: object) -> str:
    return f'{fact} was {_shown(before)}, is {_shown(now)}'


def _shown(value: object) -> str:
    """Words for a fact, without places."""
    if isinstance(value, Access):
        return _access(value)
    if isinstance(value, Blocking):
        on = f' on {_shown(value.on)}' if value.on is not None else ''
        return value.call + on + (f' for {_shown(value.seconds)} s' if value.seconds else '')
    if isinstance(value, Act):
        return _shown(value.name)
    if isinstance(value, Unknown):
        return f'unknown ({value.reason})'
    if isinstance(value, Enum):
        return str(value.value)
    if isinstance(value, tuple):
        return ', '.join(map(_shown, value)) or 'none'
    if isinstance(value, bool):
        return 'yes' if value else 'no'
    return 'none' if value is None else f'{value}'


def _access(access: Access) -> str:
    how = ' as an update' if access.update else ''
    how += ' in one piece' if access.in_place else ''
    return access.name + how + (f' under {", ".join(access.locks)}' if access.locks else '')
