"""
Flags by which callbacks keep each other out, as far as they do.

The scanner notes which code has found a flag down and put it up
(``extract/static/concurrency/accesses/flag_locks.py``). That keeps others out where nobody
else writes the flag, and where no two can find it down at once: by a lock, by a group, or because
CPython lets no other thread in between the test and the setting. That last one is no promise of
the language, so the flag itself stays shared data then.
"""

from __future__ import annotations

from collections.abc import Container, Iterable, Sequence
from dataclasses import replace
from typing import TypeVar

from ros2cc_extract.findings.base.rule import Context
from ros2cc_extract.findings.races.critical_sections import kept_between, read_for
from ros2cc_extract.findings.races.made_later import comes_first, made_by_several
from ros2cc_extract.findings.waits.workers import honours_groups, is_one_thread
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.effects import (
    FLAG,
    FOUND_NONE,
    FOUND_OTHER,
    FOUND_THIS,
    FOUND_TRUE,
    Access,
)
from ros2cc_extract.spec.model import Activity, Callback, Executor

_Doer = TypeVar('_Doer', Callback, Activity)
_Use = Callback | Activity


def shared_by(context: Context) -> tuple[Callback, ...]:
    """The user's callbacks, with their accesses as flags leave them."""
    return as_shared(context.written, context)


def shared_of_each(contexts: Sequence[Context]) -> tuple[tuple[Callback, ...], ...]:
    """The same of several units that run at the same time: a flag of one is one for all."""
    return tuple(as_shared(context.written, *contexts) for context in contexts)


def as_shared(doers: tuple[_Doer, ...], *contexts: Context) -> tuple[_Doer, ...]:
    """
    Callbacks, or threads, with their accesses as flags leave them.

    A flag that keeps others out stands among the locks and is no shared data itself, unless it
    does so by the lock of the interpreter alone; any other is shared data and no lock. What they
    make keeps the flags behind which it is made once and for all.
    """
    flags = _flags_of(contexts)
    kept = _Kept.of(flags, contexts)
    several = made_by_several(contexts)
    return tuple(
        _with_changes(_with_accesses(doer, kept) if flags else doer, kept, several)
        for doer in doers
    )


@dataclass(frozen=True)
class _Kept:
    """
    The names of flags that keep others out.

    :param at_once: the flags among ``names`` of which only the lock of the interpreter makes sure.
    :param once: those that are never put down again.
    """

    names: frozenset[str]
    at_once: frozenset[str]
    once: frozenset[str]

    @classmethod
    def of(cls, flags: Iterable[str], contexts: Sequence[Context]) -> _Kept:
        by_lock = frozenset(flag for flag in flags if _keeps_out(flag, contexts))
        at_once = frozenset(flag for flag in flags if _is_claimed_at_once(flag, contexts))
        once = (flag for flag in by_lock | at_once if _stays_up(flag, contexts))
        return cls(_bare(by_lock | at_once), _bare(at_once - by_lock), _bare(once))


def _bare(flags: Iterable[str]) -> frozenset[str]:
    return frozenset(flag.removesuffix(FLAG) for flag in flags)


def _with_accesses(doer: _Doer, kept: _Kept) -> _Doer:
    return replace(
        doer,
        reads=_judged(doer.reads, kept),
        writes=_judged(doer.writes, kept),
        pieces=_judged(doer.pieces, kept),
    )


def _with_changes(doer: _Doer, kept: _Kept, several: Container[Place | None]) -> _Doer:
    changes = tuple(
        replace(act, held=tuple(flag for flag in act.held if flag.removesuffix(FLAG) in kept.once))
        for act in doer.changes
        if act.source not in several or comes_first(doer)
    )
    return doer if changes == doer.changes else replace(doer, changes=changes)


def _flags_of(contexts: Iterable[Context]) -> set[str]:
    everybody: list[_Use] = []
    for context in contexts:
        everybody += [*context.written, *context.unit.activities]
    locks = {lock for one in everybody for access in _accesses(one) for lock in access.locks}
    return {lock for lock in locks if lock.endswith(FLAG)}


def _accesses(callback: Callback | Activity) -> tuple[Access, ...]:
    return (*callback.reads, *callback.writes, *callback.pieces)


def _judged(accesses: Iterable[Access], kept: _Kept) -> tuple[Access, ...]:
    return tuple(
        replace(
            access,
            locks=tuple(
                lock
                for lock in access.locks
                if not lock.endswith(FLAG) or lock.removesuffix(FLAG) in kept.names - {access.name}
            ),
        )
        for access in accesses
        if access.name not in kept.names or access.name in kept.at_once
    )


def _keeps_out(flag: str, contexts: Sequence[Context]) -> bool:
    """Whether all that write it hold it, and one by one find it down."""
    name = flag.removesuffix(FLAG)
    of_each = [_writes_of(name, context) for context in contexts]
    writing = [context for context, found in zip(contexts, of_each, strict=True) if found]
    uses = [use for found in of_each for use in found]
    answers = [(one, write) for one, write in uses if flag not in write.locks]
    if answers and not (len(writing) == 1 and _answer_in_turn(answers, writing[0])):
        return False
    uses = [use for use in uses if use not in answers]
    setters = [(one, write) for one, write in uses if write.rests]
    if len({write.found for _, write in setters} - {None}) > 1 and any(
        write.lowers and write.found == FOUND_NONE for _, write in setters
    ):
        # Code that tests its truth finds down what is not ``None``.
        return False
    found = {write.found for _, write in setters}
    is_state = any(
        each is not None and each.startswith((FOUND_THIS, FOUND_OTHER)) for each in found
    )
    if is_state and len(found) > 1:
        # What one of them stores is for another no sign to stay away.
        return False
    if not setters:
        return len(contexts) == 1 and _is_put_up_in_turn(contexts[0].unit.executor)
    if len(writing) == 1 and _is_of_one_group(setters, writing[0]):
        return True
    return bool(frozenset.intersection(*(_locks_of(*setter) for setter in setters)))


def _is_claimed_at_once(flag: str, contexts: Sequence[Context]) -> bool:
    """Whether all that put it up do so right behind their test, and only these put it down."""
    writes = [write for _, write in _all_writes(flag, contexts)]
    claims = [write for write in writes if write.rests]
    are_of_one_kind = len({write.found for write in claims}) == 1
    are_held = all(flag in write.locks and (write.at_once or not write.rests) for write in writes)
    return bool(claims) and are_of_one_kind and are_held and _is_of_one_node(flag, contexts)


def _is_of_one_node(flag: str, contexts: Sequence[Context]) -> bool:
    """Whether the flag is one: of helper objects there may be many, and each has its own."""
    writers = [one for one, _ in _all_writes(flag, contexts)]
    owner = flag.rpartition('.')[0]
    callbacks = [one for context in contexts for one in context.unit.callbacks]
    is_of_node = any(one.cls == owner for one in callbacks)
    nodes = {one.node for one in writers if one.node is not None}
    return is_of_node and len(nodes) == 1 and all(one.count == 1 for one in writers)


def _stays_up(flag: str, contexts: Sequence[Context]) -> bool:
    """Whether nobody stores anything but a constant in it that every test takes for up."""
    writes = [write for _, write in _all_writes(flag, contexts)]
    return bool(writes) and all(write.literal and flag in write.locks for write in writes)


def _all_writes(flag: str, contexts: Sequence[Context]) -> list[tuple[_Use, Access]]:
    """Those of functions too that code has which is not scanned."""
    name = flag.removesuffix(FLAG)
    return [
        (one, write)
        for context in contexts
        for one in context.everybody
        for write in one.writes
        if write.name == name
    ]


def _writes_of(name: str, context: Context) -> list[tuple[_Use, Access]]:
    everybody: tuple[_Use, ...] = (*context.unit.callbacks, *context.unit.activities)
    return [(one, write) for one in everybody for write in one.writes if write.name == name]


def _is_of_one_group(uses: Sequence[tuple[_Use, Access]], context: Context) -> bool:
    groups = {
        context.exclusive_group(one) if isinstance(one, Callback) else None for one, _ in uses
    }
    return len(groups) == 1 and None not in groups


def _answer_in_turn(uses: Sequence[tuple[_Use, Access]], context: Context) -> bool:
    """
    Whether one doer alone puts the flag down that others put up, and only where it found it up.

    ``if self.asked: …; self.asked = False``: while that doer is at it no other finds it down, so
    none puts it up.
    """
    if not all(write.lowers and write.found == FOUND_TRUE for _, write in uses):
        return False
    doers = {one.name: one for one, _ in uses}
    return len(doers) <= 1 and all(_runs_once(one, context) for one in doers.values())


def _runs_once(doer: _Use, context: Context) -> bool:
    if isinstance(doer, Activity):
        return doer.count == 1
    return context.exclusive_group(doer) is not None


def _is_put_up_in_turn(executor: Executor) -> bool:
    """
    Whether a goal that was accepted runs before the next one is looked at.

    Then a flag that the goal callback finds down is down when execute puts it up. Source: rclpy
    7.1.6 and 9.1.2, ``executors.py`` (``_wait_for_ready_callbacks`` yields tasks before it waits),
    ``action/server.py`` (one goal is taken at a time); the events executor keeps another order.
    """
    return is_one_thread(executor) and honours_groups(executor)


def _locks_of(callback: Callback | Activity, write: Access) -> frozenset[str]:
    """The locks from the test to the setting."""
    read = read_for(write, callback)
    kept = kept_between(read, write, callback) if read is not None else ()
    return frozenset(lock for lock in kept if not lock.endswith(FLAG))
