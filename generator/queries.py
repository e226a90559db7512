"""
The query families of each profile, with words.

Those of profile paper are the seven of the published method, in its generator's order and with
its formulas (DOI 10.1142/S0218194026500439); its table lists the last but one family per
callback, its generator per group, as here.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum
from itertools import combinations

from ros2cc_extract.generator.unit import Unit, UnitCallback, UnitGroup


class Family(Enum):
    """What a query asks."""

    DEADLOCK = 'deadlock'
    EXECUTABLE = 'executable'
    NEVER_TOGETHER = 'never_together'
    GROUP_CLOSED = 'group_closed_while_running'
    CAN_OVERLAP = 'can_overlap'
    GROUP_OPEN = 'group_always_open'
    STARVATION = 'starvation'
    SELF_OVERLAP = 'self_overlap'
    PROGRESS = 'progress'


@dataclass(frozen=True, kw_only=True)
class Query:
    """
    One question to the model.

    :param words: what is claimed, in the developer's words.
    :param callbacks: names of the callbacks it is about, in the unit's order.
    :param groups: names of the groups it is about.
    """

    family: Family
    formula: str
    words: str
    callbacks: tuple[str, ...] = ()
    groups: tuple[str, ...] = ()


def paper_queries(unit: Unit) -> tuple[Query, ...]:
    """List the queries of profile paper in the order of the published generator."""
    return (
        Query(
            family=Family.DEADLOCK,
            formula='A[] not deadlock',
            words='there is no dead-lock: some step is always possible',
        ),
        *_occupation_queries(unit),
        *(_starvation_in_rounds(callback, unit.executor) for callback in unit.callbacks),
    )


def rclpy_queries(unit: Unit) -> tuple[Query, ...]:
    """
    List the queries of profile rclpy: the same families, then those the published lack.

    A spinning executor that has nothing to do is no dead-lock, so the first asks what is left.
    """
    return (
        Query(
            family=Family.DEADLOCK,
            formula='A[] (deadlock imply cb_all_served())',
            words='there is no dead-lock: whatever arrives can be served',
        ),
        *_occupation_queries(unit),
        *(_starvation_of_data(callback) for callback in unit.callbacks),
        *(_self_overlap(callback) for callback in unit.callbacks),
        *(_progress(callback, unit) for callback in unit.callbacks if callback.needs),
    )


def write_query_file(queries: tuple[Query, ...]) -> str:
    """Write ``queries`` as a ``.q`` file: each a comment and a formula."""
    return '\n'.join(_file_entry(query) for query in queries)


def _file_entry(query: Query) -> str:
    return f'/*\n{query.words}\n*/\n{query.formula}\n'


def _occupation_queries(unit: Unit) -> Iterator[Query]:
    """The families on which callbacks run, and which groups are closed."""
    pairs = tuple(combinations(unit.callbacks, 2))
    yield from (_executable(callback) for callback in unit.callbacks)
    yield from (_never_together(a, b) for a, b in pairs)
    yield from (_group_closed(callback, unit.group_of(callback)) for callback in unit.callbacks)
    yield from (_can_overlap(a, b) for a, b in pairs)
    yield from (_group_open(group) for group in unit.groups)


def _executable(callback: UnitCallback) -> Query:
    return Query(
        family=Family.EXECUTABLE,
        formula=f'E<> cb_running({callback.index})',
        words=f'{callback.name} can run',
        callbacks=(callback.name,),
    )


def _never_together(a: UnitCallback, b: UnitCallback) -> Query:
    return Query(
        family=Family.NEVER_TOGETHER,
        formula=f'A[] not (cb_running({a.index}) and cb_running({b.index}))',
        words=f'{a.name} and {b.name} never run at the same time',
        callbacks=(a.name, b.name),
    )


def _group_closed(callback: UnitCallback, group: UnitGroup) -> Query:
    c = callback.index
    return Query(
        family=Family.GROUP_CLOSED,
        formula=f'A[] cb_running({c}) imply group_closed[cb_group_table[{c}]]',
        words=f'group {group.name} is closed while {callback.name} runs',
        callbacks=(callback.name,),
        groups=(group.name,),
    )


def _can_overlap(a: UnitCallback, b: UnitCallback) -> Query:
    return Query(
        family=Family.CAN_OVERLAP,
        formula=f'E<> (cb_running({a.index}) and cb_running({b.index}))',
        words=f'{a.name} and {b.name} can run at the same time',
        callbacks=(a.name, b.name),
    )


def _group_open(group: UnitGroup) -> Query:
    return Query(
        family=Family.GROUP_OPEN,
        formula=f'A[] not group_closed[{group.index}]',
        words=f'group {group.name} is always open to further threads',
        groups=(group.name,),
    )


def _starvation_in_rounds(callback: UnitCallback, executor: str) -> Query:
    c = callback.index
    seen_ready = f'{executor}.schedule_start and {executor}.ready_set_copy[{c}]'
    return Query(
        family=Family.STARVATION,
        formula=f'({seen_ready} and !cb_running({c})) --> cb_running({c})',
        words=f'{callback.name} never starves: once a poll has seen it ready, it runs',
        callbacks=(callback.name,),
    )


def _starvation_of_data(callback: UnitCallback) -> Query:
    c = callback.index
    return Query(
        family=Family.STARVATION,
        formula=f'(cb_waiting[{c}] > 0 and !cb_running({c})) --> cb_running({c})',
        words=f'{callback.name} never starves: once something has arrived for it, it runs',
        callbacks=(callback.name,),
    )


def _self_overlap(callback: UnitCallback) -> Query:
    return Query(
        family=Family.SELF_OVERLAP,
        formula=f'A[] cb_runs({callback.index}) <= 1',
        words=f'{callback.name} never overlaps itself',
        callbacks=(callback.name,),
    )


def _progress(callback: UnitCallback, unit: Unit) -> Query:
    """Arrivals are bounded, so whoever is stuck is stuck when nothing moves any more."""
    needs = ' and '.join(dict.fromkeys(unit.callbacks[place].name for place in callback.needs))
    return Query(
        family=Family.PROGRESS,
        formula=f'A[] not (deadlock and cb_unfinished({callback.index}))',
        words=f'{callback.name} always ends: {needs} can run while it waits',
        callbacks=(callback.name,),
    )
