"""Which locks a callback holds while it waits."""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.extract.static.concurrency.machine.state import ConcurrentWorld
from ros2cc_extract.extract.static.python.machine.library_state import PlainState
from ros2cc_extract.extract.static.python.machine.path_facts import Word
from ros2cc_extract.extract.static.python.machine.waitable_objects import INITIAL
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Const,
    Instance,
    Library,
    Value,
    options_of,
)
from ros2cc_extract.spec.effects import AWAIT, RE_ENTRANT

GIVEN = '__given_lock__'
"""Slot of a condition for the lock that it was made with."""

#: Source: ``threading.py``; a ``Condition`` holds an ``RLock`` where it is given none.
_RE_ENTRANT = {'lock': False, 'rlock': True, 'condition': True}


def held_over(world: ConcurrentWorld, on: Value | None) -> tuple[str, ...]:
    """
    Name the locks that are held while ``on`` is waited for, outermost first.

    What may not keep others out is omitted: semaphores, locks of the program's own,
    locks that were taken with a time-out. A condition is given back while it is waited for.
    """
    tried = {act.name for act in world.effects.locks if act.tries} if world.effects else set()
    return tuple(
        name + RE_ENTRANT * _RE_ENTRANT[kind]
        for name in dict.fromkeys(world.held)
        if name not in tried
        for lock, kind in locks_named(name, world)
        if on is None or all(lock_of(option) is not lock for option in options_of(on))
    )


def taking_of(world: ConcurrentWorld, thing: Instance) -> str:
    """What the wait for a semaphore is called; a lock of asyncio is one, of one permit."""
    names = [cls.name for cls in thing.mro if isinstance(cls, Library)]
    if 'threading.Lock' in names:
        return 'Lock.acquire'
    if not any(name.startswith('asyncio.') for name in names):
        return 'Semaphore.acquire'
    return f'{AWAIT} asyncio.Lock.acquire' if world.is_on_loop else 'asyncio.Lock.acquire'


def is_counter(world: ConcurrentWorld, thing: Instance) -> bool:
    """
    Whether a semaphore begins with nothing to take: others must give first, so it is no lock.

    What the set-up gives is there before any callback takes it.
    """
    if thing.slots.get(INITIAL) != Const(0):
        return False
    given = world.wakings.get(id(thing), ())
    return not any(waking.by is None and waking.word is Word.RELEASE for waking in given)


def is_signal(world: ConcurrentWorld, lock: Instance) -> bool:
    """Whether others than those that take a lock give it back."""
    state = lock.state
    is_stock = isinstance(state, PlainState) and state.kind == 'semaphore'
    return is_stock or is_counter(world, lock)


def holds_lock_of(world: ConcurrentWorld, thing: Value) -> bool:
    """Whether the lock of a condition, or one that may be it, is held."""
    return all(
        any(each is lock_of(option) for name in world.held for each, _ in locks_named(name, world))
        for option in options_of(thing)
    )


def lock_of(thing: Value) -> Value:
    """The lock that is taken with ``thing``: a condition may have been given one."""
    given = thing.slots.get(GIVEN) if isinstance(thing, Instance) else None
    options = options_of(given) if isinstance(given, Value) and given != NONE else ()
    state = options[0].state if len(options) == 1 and isinstance(options[0], Instance) else None
    is_lock = isinstance(state, PlainState) and state.kind in ('lock', 'rlock')
    return options[0] if is_lock else thing


def locks_named(name: str, world: ConcurrentWorld) -> Iterator[tuple[Instance, str]]:
    """The lock of that name, with its kind."""
    hint, _, number = name.rpartition('#')
    for stored, place in ((name, 0), (hint, int(number) - 1 if number.isdecimal() else -1)):
        locks = world.locks.get(stored, ())
        if 0 <= place < len(locks):
            state = locks[place].state
            if isinstance(state, PlainState) and state.kind in _RE_ENTRANT:
                yield locks[place], state.kind
                return
