"""
How many callbacks can wait at the same time, each holding a worker thread.

An exclusive group lets one of its members in, branches of one ``alternative`` mark never
coexist, everything else may coincide. So a largest set of simultaneous waiters is a maximum
matching between groups and marks, where a reentrant callback has a group of its own and an
unmarked one a mark of its own. Where branches are distinguished, the one with most waiters counts.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence

from ros2cc_extract.findings.base.rule import Context
from ros2cc_extract.findings.waits.one_shot_timers import cancels_too_late
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.spec.model import Callback
from ros2cc_extract.spec.self_exclusion import admits_one, is_made_once, lets_one_wait

Key = tuple[str, str, int]
Matching = dict[Key, tuple[Key, int]]
"""Mark to the group it is matched with and the number of the callback that joins them."""


@dataclass(frozen=True)
class Capacity:
    """
    The largest set of callbacks that can wait at once.

    :param together: one such set, without repetitions of a callback with itself.
    :param times: how often each of them is in the set.
    :param at_least: its size, entities of loops counted as often as they are made, services as
        often as known clients may ask them at a time.
    :param unbounded: callbacks that may also overlap themselves, so that no number is enough.
    """

    together: tuple[Callback, ...]
    times: tuple[int, ...]
    at_least: int
    unbounded: tuple[Callback, ...]


def capacity_of(waiters: Sequence[Callback], context: Context) -> Capacity:
    """Decide the capacity of ``waiters``, callbacks of the unit without repetition."""
    waiters = _of_largest_branches(waiters)
    edges: dict[Key, list[tuple[Key, int]]] = {}
    for number, waiter in enumerate(waiters):
        for copy in range(_copies(waiter, context)):
            edges.setdefault(_group_key(waiter, copy, context), []).append(
                (_mark_key(waiter, copy), number)
            )
    matched: Matching = {}
    for group in edges:
        _augment(group, edges, matched, set())
    chosen = Counter(sorted(number for _, number in matched.values()))
    return Capacity(
        together=tuple(waiters[number] for number in chosen),
        times=tuple(chosen.values()),
        at_least=chosen.total(),
        unbounded=tuple(w for w in waiters if can_overlap_itself(w, context)),
    )


def _of_largest_branches(waiters: Sequence[Callback]) -> list[Callback]:
    """Of the branches of each mark, those that wait in the one with most of them."""
    branches = [w for w in waiters if w.alternative is not None and w.branch is not None]
    sizes = Counter((waiter.alternative, waiter.branch) for waiter in branches)
    largest: dict[str | None, int | None] = {}
    for (mark, branch), _ in sizes.most_common():
        largest.setdefault(mark, branch)
    left = [w for w in branches if largest[w.alternative] != w.branch]
    return [waiter for waiter in waiters if waiter not in left]


def can_overlap_itself(callback: Callback, context: Context) -> bool:
    """
    True when one entity may run concurrently with itself.

    Source: rclpy 7.1.6, ``executors.py`` (``_make_handler``): an entity may be collected again
    as soon as its data was taken; only an exclusive group refuses the second start. Work in no
    group runs once per task, but a server makes one per goal.
    """
    group = context.group_of(callback)
    if group.unresolved is not None or runs_once(callback):
        return False
    return context.exclusive_group(callback) is None


def runs_once(callback: Callback) -> bool:
    """Whether its entity runs it a single time."""
    is_one_shot = callback.one_shot and not cancels_too_late(callback)
    return is_one_shot or is_made_once(callback)


def _copies(callback: Callback, context: Context) -> int:
    """
    Count the runs that may coincide.

    A loop makes several entities; in exclusive groups they coincide if it makes groups too. Else
    a service runs as often at a time as known clients may ask it.
    """
    group = context.group_of(callback)
    own = callback.count if isinstance(callback.count, int) else 1
    if context.exclusive_group(callback) is None:
        is_held_back = lets_one_wait(callback) or admits_one(callback, context.unit)
        return own if is_held_back else max(own, callback.askers)
    return min(own, group.count) if isinstance(group.count, int) else 1


def _group_key(waiter: Callback, copy: int, context: Context) -> Key:
    group = context.exclusive_group(waiter)
    return ('group', group.name, copy) if group else ('callback', waiter.name, copy)


def _mark_key(waiter: Callback, copy: int) -> Key:
    if waiter.alternative is None or waiter.branch is not None:
        return ('callback', waiter.name, copy)
    return ('mark', waiter.alternative, 0)


def _augment(
    group: Key, edges: Mapping[Key, list[tuple[Key, int]]], matched: Matching, tried: set[Key]
) -> bool:
    """Find a mark for ``group``, moving others to further marks where that makes room."""
    for mark, number in edges[group]:
        if mark in tried:
            continue
        tried.add(mark)
        if mark not in matched or _augment(matched[mark][0], edges, matched, tried):
            matched[mark] = (group, number)
            return True
    return False
