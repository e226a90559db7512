"""
Objects that callbacks hand on to each other: a state that gives the next one, a strategy.

A callback is followed with what an attribute holds then. Where it holds another object later,
the callback is followed again; where that comes to no end, the unit says so.
"""

from __future__ import annotations

from collections.abc import Mapping

from ros2cc_extract.extract.static.values import (
    Bound,
    Class,
    Function,
    Heaped,
    Instance,
    Partial,
    Value,
    options_of,
)
from ros2cc_extract.extract.static.world import Cut, EntityState, World, note_once

_ROUNDS = 10
"""A chain of as many states is followed to its end."""

Tokens = frozenset[object]


def note_met(world: World, owner: Heaped, name: str, held: Value | None) -> None:
    """The running callback reads ``owner.name``, which others assign."""
    objects = _objects(held)
    if objects:
        known = world.met.get((owner, name), frozenset())
        world.met[(owner, name)] = known | objects


def _objects(held: object) -> Tokens:
    """What somebody may call, or call a method of."""
    if not isinstance(held, Value):
        return frozenset()
    tokens = (_token(option) for option in options_of(held))
    return frozenset(token for token in tokens if token is not None)


def _token(value: Value) -> object:
    """Equal for functions of one text: a lambda is another object each time it is made."""
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


def next_round(world: World) -> list[EntityState]:
    """The callbacks to follow once more."""
    stale = [entity for entity in world.entities if has_news(world.met_by.get(id(entity), {}))]
    found = []
    for entity in stale:
        world.rounds[id(entity)] += 1
        if world.rounds[id(entity)] <= _ROUNDS:
            found.append(entity)
        else:
            reason = 'objects that callbacks hand on to each other are not followed to an end'
            classes = frozenset(cls for cls in entity.node.mro if isinstance(cls, Class))
            note_once(world.cut, Cut(reason, entity.place, classes))
    return found
