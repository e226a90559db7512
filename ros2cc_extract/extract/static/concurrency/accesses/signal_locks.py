"""
Locks that are signals: one callback or thread takes them, and another one gives them back.

A ``threading.Lock`` has no owner, so it may be used as a semaphore of one permit. A callback that
gives a lock back which it never takes itself shows that. Whether it does is known when all was
followed; the program is then followed once more with that knowledge.
"""

from __future__ import annotations

from collections.abc import Iterable

from ros2cc_extract.extract.static.concurrency.machine.state import ConcurrentWorld, LockUse
from ros2cc_extract.extract.static.python.machine.library_state import PlainState
from ros2cc_extract.extract.static.python.values.values import Instance
from ros2cc_extract.source_locations import Place


def note_taken(world: ConcurrentWorld, lock: Instance) -> None:
    """The callback or thread that is followed takes ``lock``."""
    _use_of(world, lock).takers.add(_doer(world))


def note_given(world: ConcurrentWorld, lock: Instance) -> None:
    """The callback or thread that is followed gives ``lock`` back."""
    _use_of(world, lock).givers.add(_doer(world))


def signals_of(world: ConcurrentWorld) -> frozenset[Place]:
    """Where the locks are made that are signals."""
    locks = [lock for lock in _given_by_others(world) if isinstance(lock.state, PlainState)]
    return frozenset(lock.place for lock in locks if lock.state.kind == 'lock')


def are_signals(world: ConcurrentWorld, locks: Iterable[Instance]) -> bool:
    """Whether one of the locks or semaphores is given back by code that never takes it."""
    given = _given_by_others(world)
    return any(lock is each for lock in locks for each in given)


def _given_by_others(world: ConcurrentWorld) -> list[Instance]:
    uses = world.lock_uses.values()
    return [use.lock for use in uses if use.takers and use.givers - use.takers - {None}]


def _use_of(world: ConcurrentWorld, lock: Instance) -> LockUse:
    return world.lock_uses.setdefault(id(lock), LockUse(lock))


def _doer(world: ConcurrentWorld) -> int | None:
    """Its identity; ``None`` for the set-up, which a lock is given back to no one by."""
    doer = world.activity or (world.current if world.effects is not None else None)
    return id(doer) if doer is not None else None
