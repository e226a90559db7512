"""
The query families of each profile, with words.

Those of profile paper are the seven of the published method, in its generator's order and with
its formulas (DOI 10.1142/S0218194026500439); its table lists the last but one family per
callback, its generator per group, as here.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from enum import Enum
from itertools import combinations

from ros2cc_extract.generator.nested_spins import Spun
from ros2cc_extract.generator.unit import Unit, UnitActivity, UnitCallback, UnitGroup
from ros2cc_extract.light_dataclasses import dataclass


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
    POOL_EXHAUSTION = 'pool_exhaustion'
    OUTSIDE_GROUPS = 'outside_groups'
    SERIAL = 'serial'
    STRUCTURAL_STARVATION = 'structural_starvation'
    ANSWERED_SPIN = 'answered_spin'
    NODE_KEPT = 'node_kept'


@dataclass(frozen=True, kw_only=True)
class Query:
    """
    One question to the model.

    :param words: what is claimed, in the developer's words.
    :param callbacks: names of the callbacks it is about, in the unit's order.
    :param groups: names of the groups it is about.
    :param left_out: what the node does that is not in the model and could refute the claim.
    :param whatever: the claim for any value of what is not known; ``formula`` then counts only
        runs in which that does not matter. ``formula`` refutes a claim, ``whatever`` proves it.
    """

    family: Family
    formula: str
    words: str
    callbacks: tuple[str, ...] = ()
    groups: tuple[str, ...] = ()
    left_out: tuple[str, ...] = ()
    whatever: str | None = None


def paper_queries(unit: Unit) -> tuple[Query, ...]:
    """
    List the queries of profile paper in the order of the published generator.

    Its callbacks always end; a recorded run that did not says otherwise.
    """
    stuck = tuple(words for callback in unit.callbacks for words in callback.unexplained)
    asked = (
        Query(
            family=Family.DEADLOCK,
            formula='A[] not deadlock',
            words='there is no deadlock: some step is always possible',
        ),
        *_occupation_queries(unit),
        *(_starvation_in_rounds(callback, unit.executor) for callback in unit.callbacks),
    )
    if not stuck:
        return asked
    return tuple(replace(q, left_out=stuck) if q.family in _OF_ENDS else q for q in asked)


def rclpy_queries(unit: Unit) -> tuple[Query, ...]:
    """
    List the queries of profile rclpy: the same families, then those the published lack.

    A spinning executor that has nothing to do is no deadlock, so the first asks what is left.
    """
    asked = (
        Query(
            family=Family.DEADLOCK,
            formula=f'A[] (deadlock imply cb_all_served(){_none_blocked(unit)})',
            words='there is no deadlock: all that arrives can be served',
        ),
        *_occupation_queries(unit),
        *(_starvation_of_data(callback) for callback in unit.callbacks),
        *(_self_overlap(callback) for callback in unit.callbacks),
        *(_progress(callback, unit) for callback in unit.callbacks if waits(callback)),
        *(_progress_beside(activity) for activity in unit.activities if activity.is_asked),
        *_pool_exhaustion(unit),
        *_outside_groups(unit),
        _serial(unit),
        *(_answered_spin(callback, unit) for callback in unit.callbacks if _spun_for(callback)),
        *(_node_kept(callback) for callback in unit.callbacks if _moved_nodes(callback)),
    )
    if any(callback.left_out for callback in unit.callbacks):
        asked = tuple(replace(query, left_out=_left_out(query, unit)) for query in asked)
    return tuple(map(_without_doubt, asked)) if unit.has_doubts else asked


def _without_doubt(query: Query) -> Query:
    """Count runs only in which nothing is in doubt, and keep the claim about all runs."""
    if query.family not in _OF_ENDS:
        return query
    if query.family is Family.STARVATION:
        formula = f'{query.formula} or {IN_DOUBT}'
    else:
        formula = query.formula.replace('deadlock', f'deadlock and !{IN_DOUBT}', 1)
    return replace(query, formula=formula, whatever=query.formula)


def waits(callback: UnitCallback) -> bool:
    """Return whether it may not come to its end, as far as the callback itself says."""
    return bool(callback.needs or callback.left_out)


#: Whether it counts in a run that something is not known; of models that have doubts.
IN_DOUBT = 'in_doubt'
#: Families whose claims rest on every callback coming to its end.
_OF_ENDS = (Family.DEADLOCK, Family.STARVATION, Family.PROGRESS, Family.POOL_EXHAUSTION)
#: Families about a callback that others may run inside of, in a nested spin.
_OF_OVERLAP = (
    Family.NEVER_TOGETHER,
    Family.CAN_OVERLAP,
    Family.SELF_OVERLAP,
    Family.OUTSIDE_GROUPS,
)


def _left_out(query: Query, unit: Unit) -> tuple[str, ...]:
    if query.family in _OF_ENDS:
        return tuple(words for callback in unit.callbacks for words in callback.left_out)
    if query.family in (*_OF_OVERLAP, Family.SERIAL):
        concerned = query.callbacks or [callback.name for callback in unit.callbacks]
        entered = (c for c in unit.callbacks if c.is_entered and c.name in concerned)
        return tuple(words for callback in entered for words in callback.left_out)
    return ()


def write_query_file(queries: tuple[Query, ...]) -> str:
    """Write ``queries`` as a ``.q`` file: each a comment and a formula."""
    return '\n'.join(_file_entry(query) for query in with_doubts(queries))


def with_doubts(queries: tuple[Query, ...]) -> Iterator[Query]:
    """Queries as a file has them: one after the other, each about all runs behind it."""
    for query in queries:
        yield query
        if query.whatever is not None:
            words = f'{query.words}, for all values of what is not known'
            yield replace(query, formula=query.whatever, words=words)


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
    """Arrivals are bounded, so what is stuck is stuck when nothing moves any more."""
    ending = [
        ' or '.join(wait.wakers) or unit.callbacks[wait.place].name
        for wait in callback.waits
        if wait.is_for_callback or wait.wakers
    ]
    needs = ' and '.join(dict.fromkeys(ending))
    words = f': {needs} can run while it waits' if needs else ''
    return Query(
        family=Family.PROGRESS,
        formula=f'A[] not (deadlock and cb_unfinished({callback.index}))',
        words=f'{callback.name} always ends{words}',
        callbacks=(callback.name,),
    )


def _none_blocked(unit: Unit) -> str:
    """Say that no activity waits, of those whose waits are all known."""
    blocked = ' or '.join(f'{a.name}.blocked' for a in unit.activities if a.is_asked)
    return f' and not ({blocked})' if blocked else ''


def _progress_beside(activity: UnitActivity) -> Query:
    """Ask whether a thread of the program's own comes out of its waits."""
    return Query(
        family=Family.PROGRESS,
        formula=f'A[] not (deadlock and {activity.name}.blocked)',
        words=f'{activity.name}, which runs beside the executor, never waits forever',
        callbacks=(activity.name,),
    )


def _pool_exhaustion(unit: Unit) -> Iterator[Query]:
    """Every thread waits, and what could end a wait would need one."""
    waiting = [
        c
        for c in unit.callbacks
        if any(not wait.frees_thread and not wait.is_signal for wait in c.waits)
    ]
    if not waiting:
        return
    held = '({0}.blocked or {0}.spinning)' if unit.has_spins else '{}.blocked'
    blocked = ' and '.join(held.format(thread) for thread in unit.threads)
    yield Query(
        family=Family.POOL_EXHAUSTION,
        formula=f'A[] not (deadlock and {blocked})',
        words='the threads are never all taken by callbacks that wait forever',
        callbacks=tuple(callback.name for callback in waiting),
    )


def _outside_groups(unit: Unit) -> Iterator[Query]:
    """Work in no group: done-callbacks, tasks, execute callbacks of actions."""
    for callback in unit.callbacks:
        for group in unit.groups:
            if callback.is_groupless and group.type == 'EXCLUSIVE':
                yield Query(
                    family=Family.OUTSIDE_GROUPS,
                    formula=f'A[] not (cb_running({callback.index}) and '
                    f'group_closed[{group.index}])',
                    words=f'{callback.name}, which is in no group, never runs while a member of '
                    f'{group.name} does',
                    callbacks=(callback.name,),
                    groups=(group.name,),
                )


def _serial(unit: Unit) -> Query:
    one_thread = (
        'A[] forall (a : ThreadId) forall (b : ThreadId) '
        '(thread_running[a] and thread_running[b] imply a == b)'
    )
    # A nested spin runs others on its own thread.
    one_callback = 'A[] (sum (c : CbId) cb_runs(c)) <= 1'
    return Query(
        family=Family.SERIAL,
        formula=one_callback if unit.has_spins else one_thread,
        words='no two callbacks ever run at the same time: groups and threads have no effect',
    )


def _spun_for(callback: UnitCallback) -> tuple[int, ...]:
    """Places of the callbacks that a callback spins for."""
    return tuple(wait.place for wait in callback.waits if wait.spin and wait.is_for_callback)


def _answered_spin(callback: UnitCallback, unit: Unit) -> Query:
    """With a time-out a nested spin ends in any case, and the question is with what."""
    needs = ' and '.join(dict.fromkeys(unit.callbacks[p].name for p in _spun_for(callback)))
    c = callback.index
    answered = ' or '.join(
        f'({thread}.answered and thread_cb_assign_table[{number}] == {c})'
        for number, thread in enumerate(unit.threads)
    )
    return Query(
        family=Family.ANSWERED_SPIN,
        formula=f'E<> ({answered})',
        words=f'{callback.name} can get what it spins for: {needs} can run inside',
        callbacks=(callback.name,),
    )


def _moved_nodes(callback: UnitCallback) -> tuple[int, ...]:
    """Places of the nodes that a callback gives to the global executor."""
    moved = (w.node for w in callback.waits if w.spin and w.spin.spun is Spun.GLOBAL)
    return tuple(dict.fromkeys(moved))


def _node_kept(callback: UnitCallback) -> Query:
    taken = ' or '.join(f'node_taken[{node}]' for node in _moved_nodes(callback))
    return Query(
        family=Family.NODE_KEPT,
        formula=f'A[] not (cb_running({callback.index}) and ({taken}))',
        words=f'{callback.name} runs without its node being taken out of the executor',
        callbacks=(callback.name,),
    )


def structural_starvation(callback: UnitCallback) -> Query:
    """
    Ask of a unit without a bound on arrivals, whose callbacks all end, with fair threads.

    Not satisfied means *possible under overload*: whether it happens, the rates decide.
    """
    return replace(
        _starvation_of_data(callback),
        family=Family.STRUCTURAL_STARVATION,
        words=f'{callback.name} is served however much arrives for others, while all end',
    )
