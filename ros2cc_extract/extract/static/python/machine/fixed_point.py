"""
Objects that callbacks hand on to each other: a state that gives the next one, a strategy.

A callback is followed with what an attribute holds then. Where it holds another object later,
the callback is followed again; where that comes to no end, the unit says so.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import TypeVar

from ros2cc_extract.extract.static.python.machine.recorded_effects import Doer
from ros2cc_extract.extract.static.python.machine.waitable_objects import is_waited_on
from ros2cc_extract.extract.static.python.machine.world import Cut, World, note_once
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Bound,
    Class,
    Const,
    Function,
    Heaped,
    Instance,
    Partial,
    Value,
    options_of,
)
from ros2cc_extract.source_locations import Place

_ROUNDS = 10
"""A chain of as many states is followed to its end."""

Tokens = frozenset[object]
Followed = TypeVar('Followed', bound=Doer)


def note_met(world: World, owner: Heaped, name: str, held: Value | None) -> None:
    """
    The running callback reads ``owner.name``, which others assign.

    What it has just made and put there it finds there each time, whatever others assign.
    """
    is_own = isinstance(held, Instance) and held.born is not None and held.born is world.effects
    if _objects(held) and not is_own:
        note_found(world, owner, name, held)


def note_found(world: World, owner: Heaped, name: str, held: Value | None) -> None:
    """The same where it matters too that nothing was assigned yet."""
    known = world.met.get((owner, name), frozenset())
    world.met[(owner, name)] = known | _objects(held)


def is_same_text(one: Value, other: Value) -> bool:
    """Whether both are functions of one text on one object."""
    return one is other or (_token(one) is not None and _token(one) == _token(other))


def _objects(held: object) -> Tokens:
    """What code may call, or call a method of."""
    if not isinstance(held, Value):
        return frozenset()
    tokens = (_token(option) for option in options_of(held))
    return frozenset(token for token in tokens if token is not None)


def _token(value: Value) -> object:
    """
    Equal for functions of one text: a lambda is another object each time it is made.

    So is a future that a callback makes in each run: what ends the wait for one ends it for all.
    """
    if isinstance(value, Instance) and is_waited_on(value):
        return value.place
    if isinstance(value, Instance):
        return value if isinstance(value.cls, Class) else None
    if isinstance(value, Bound):
        return (value.receiver, id(value.function.node))
    if isinstance(value, Partial):
        return _token(value.function)
    if isinstance(value, Function):
        return id(value.node)
    return value if isinstance(value, Class) else None


def has_news(met: Mapping[tuple[Heaped, str], Tokens]) -> bool:
    """Whether something that was read holds other objects now."""
    return any(
        not _objects(owner.slots.get(name)) <= objects for (owner, name), objects in met.items()
    )


def _has_other_kinds(met: Mapping[tuple[Heaped, str], Tokens]) -> bool:
    """
    Whether something holds objects now that are not like those which were read.

    A callback that makes an object in each run comes to no end, and after some of its runs to
    nothing new: each is made at the same place and holds what others there have held.
    """
    return any(
        not _kinds(_objects(owner.slots.get(name))) <= _kinds(known)
        for (owner, name), known in met.items()
    )


def _kinds(tokens: Tokens) -> Tokens:
    """The places where objects are made, with the values and kinds of objects they hold."""
    return frozenset(kind for token in tokens for kind in _kinds_of(token))


def _kinds_of(token: object) -> Iterator[object]:
    if isinstance(token, Place):
        return  # it holds nothing, and is made once more in each run
    if isinstance(token, tuple):
        receiver, function = token
        yield from ((kind, function) for kind in _kinds_of(receiver))
    elif not isinstance(token, Instance) or token.born is None:
        yield token
    else:
        made = token.cls, token.place
        yield made
        slots = [slot for slot in token.slots.items() if isinstance(slot[1], Value)]
        held = ((name, _shown(option)) for name, slot in slots for option in options_of(slot))
        yield from ((made, name, shown) for name, shown in held if shown is not None)


def _shown(value: Value) -> object:
    if isinstance(value, Instance):
        return value.cls
    if isinstance(value, Const):
        return repr(value.value) if value != NONE else None
    if isinstance(value, Bound):
        return _shown(value.receiver), id(value.function.node)
    return _token(value)


def next_round(world: World, doers: Iterable[Followed]) -> list[Followed]:
    """The callbacks to follow once more."""
    stale = [entity for entity in doers if has_news(world.met_by.get(id(entity), {}))]
    found = []
    for entity in stale:
        world.rounds[id(entity)] += 1
        if world.rounds[id(entity)] <= _ROUNDS:
            found.append(entity)
        elif _has_other_kinds(world.met_by.get(id(entity), {})):
            reason = 'objects that callbacks hand on to each other are not followed to an end'
            order = entity.owner.mro if entity.owner is not None else ()
            classes = frozenset(cls for cls in order if isinstance(cls, Class))
            note_once(world.cut, Cut(reason, entity.place, classes))
    return found
