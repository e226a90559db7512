"""
Calls that work on plain data alone, and for long: they are left, and what they gave is unknown.

Programs that read a file of some nested format spend their time there, and what matters would
not be reached. A call is plain by what its text names, and the text of all that it may lead to,
by name; so it is never one that starts, locks or waits for anything, nor one that the model of
its libraries says to act.
"""

from __future__ import annotations

from collections.abc import Iterable

from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.machine.world import World
from ros2cc_extract.extract.static.python.objects.reachable_texts import (
    leads_nowhere,
)
from ros2cc_extract.extract.static.python.values.containers import Collection, Mapping, Sequence
from ros2cc_extract.extract.static.python.values.values import (
    Bound,
    Call,
    Function,
    Heaped,
    Instance,
    Module,
    Mystery,
    Value,
    options_of,
)
from ros2cc_extract.source_locations import Unknown

LONG = 5_000
"""After so many steps of one piece of a program plain calls are counted."""

FOR_EACH, AT_LEAST, FOR_ALL = 10_000, 150, 60_000
"""Steps that all plain calls of one function may take, each call at least, all in one run."""


def is_plain(machine: Machine, function: Function) -> bool:
    """Whether nothing that ``function`` may lead to acts: makes, serves, starts, locks, waits."""
    world = machine.world
    if world.plain_of != len(world.trees):
        # What is imported later may define more functions of a name.
        world.plain, world.plain_of = {}, len(world.trees)
    known = world.plain.get(id(function.node))
    if known is None:
        known = world.plain[id(function.node)] = leads_nowhere(machine, function.node)
    return known


def allowance(world: World, function: Function) -> int:
    """How many steps the next plain call of ``function`` may take."""
    left = min(FOR_EACH - world.spent[id(function.node)], FOR_ALL - world.spent[0])
    return max(AT_LEAST, left)


def note_spent(world: World, function: Function, steps: int) -> None:
    """A plain call of ``function`` has taken so many steps."""
    world.spent[id(function.node)] += steps
    world.spent[0] += steps


def leave(machine: Machine, function: Function, call: Call) -> Value:
    """What a call gives that is left before its end; what it was given may be changed by then."""
    why = Unknown(f'{function.name} works on plain data for long: it is not followed', call.place)
    for value in _reached([*call.args, *call.keywords.values(), function.module]):
        if isinstance(value, Collection):
            machine.store.write(value, 'open', why)
    return Mystery(why, f'{function.name}(…)')


def _reached(values: Iterable[Value]) -> list[Heaped]:
    """The collections that can be reached from here: two objects deep, and what they hold."""
    found: dict[int, Heaped] = {}
    waiting = [(value, 2) for value in values]
    while waiting:
        value, deep = waiting.pop()
        for option in options_of(value):
            inner = option.receiver if isinstance(option, Bound) else option
            if not isinstance(inner, (Collection, Instance, Module)) or id(inner) in found:
                continue
            found[id(inner)] = inner
            if deep:
                waiting += ((each, deep - 1) for each in _held_by(inner))
    return list(found.values())


def _held_by(value: Heaped) -> list[Value]:
    if isinstance(value, Mapping):
        return list(value.entries.values())
    held = value.items if isinstance(value, Sequence) else value.slots.values()
    return [each for each in held if isinstance(each, Value)]
