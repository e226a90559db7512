"""
What is in a queue, as data that several callbacks ask for and change.

``put`` and ``get`` are each in one piece, by a lock of the queue itself. A question to it is not
in one piece with what follows: both are code of Python (CPython 3.12, ``queue.py``).
"""

from __future__ import annotations

from ros2cc_extract.extract.static.concurrency.machine.machine import ConcurrentMachine
from ros2cc_extract.extract.static.python.machine.world import note_once
from ros2cc_extract.extract.static.python.values.values import Instance, Value
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.effects import ADDS, FILLS, TAKES, TAKES_NEXT, Access

_ANY = ('Exception', 'BaseException')
_LACKING = frozenset({'queue.Empty', 'Empty', *_ANY})
_NO_ROOM = frozenset({'queue.Full', 'Full', *_ANY})


def note_asked(machine: ConcurrentMachine, queue: Value, place: Place) -> None:
    """``empty()``, ``full()``, ``qsize()``."""
    name, effects = _name(machine, queue), machine.world.effects
    if name is None or effects is None:
        return
    world = machine.world
    world.reading.note_read(name)
    access = Access(name=name, source=place, locks=world.held, chain=world.chain[1:])
    note_once(effects.reads, access)


def note_taken(machine: ConcurrentMachine, queue: Value, place: Place, *, waits: bool) -> None:
    """An item is taken out; code that catches that there is none may take it."""
    is_expected = not waits and _is_caught(machine, _LACKING)
    _note(machine, queue, place, TAKES if is_expected else TAKES_NEXT)


def note_given(
    machine: ConcurrentMachine, queue: Value, place: Place, *, is_bounded: bool, waits: bool
) -> None:
    """An item is put in, where there is room."""
    is_expected = not waits and _is_caught(machine, _NO_ROOM)
    _note(machine, queue, place, FILLS if is_bounded and not is_expected else ADDS)


def _note(machine: ConcurrentMachine, queue: Value, place: Place, moves: str) -> None:
    name, effects = _name(machine, queue), machine.world.effects
    if name is None or effects is None:
        return
    world = machine.world
    access = Access(
        name=name,
        source=place,
        locks=world.held,
        update=True,
        in_place=True,
        moves=moves,
        rests=moves != TAKES and world.reading.leads_to(name, world.path),
        chain=world.chain[1:],
    )
    note_once(effects.writes, access)


def _name(machine: ConcurrentMachine, queue: Value) -> str | None:
    """What a queue is called that others may see."""
    effects = machine.world.effects
    if effects is None or not isinstance(queue, Instance) or queue.born is effects:
        return None
    return machine.lock_name(queue, 'queue')


def _is_caught(machine: ConcurrentMachine, kinds: frozenset[str]) -> bool:
    return not all(kinds.isdisjoint(caught) for caught in machine.world.caught)
