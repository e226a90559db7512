"""A callback that is followed again: what it does then, and what it was seen to do before."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

from ros2cc_extract.extract.static.python.machine.recorded_effects import EffectLog
from ros2cc_extract.extract.static.python.machine.world import World
from ros2cc_extract.extract.static.python.values.values import Class, Instance, Library
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.effects import Access, Act, Blocking

Effect = TypeVar('Effect', Access, Act, Blocking)


def both(before: EffectLog, again: EffectLog) -> EffectLog:
    """Merge two logs: what the second says of a place replaces what the first says of it."""
    return EffectLog(
        blocking=_both(before.blocking, again.blocking, lambda effect: effect.call),
        reads=_both(before.reads, again.reads, lambda effect: (effect.name, effect.update)),
        writes=_both(before.writes, again.writes, lambda effect: (effect.name, effect.update)),
        locks=_both(before.locks, again.locks, lambda effect: effect.name),
        publishes=_both(before.publishes, again.publishes, lambda effect: effect.name),
        changes=_both(before.changes, again.changes, lambda effect: effect.name),
        pieces=list(dict.fromkeys((*before.pieces, *again.pieces))),
        stored={**before.stored, **again.stored},
        written={**before.written, **again.written},
        looped=before.looped | again.looped,
        exits=before.exits | again.exits,
        steps={**before.steps, **again.steps},
    )


def remember(world: World, cls: Class | Library, place: Place, instance: Instance) -> Instance:
    """Keep what a callback makes, for when it is followed again."""
    if world.effects is not None or world.activity is not None:
        world.made_then[_site(world, cls, place)] = instance
    return instance


def made_then(world: World, cls: Class | Library, place: Place) -> Instance | None:
    """What the running callback made here when it was followed before."""
    known = world.made_then.get(_site(world, cls, place)) if world.again else None
    if known is not None:
        _own(world, known)
    return known


def note_part(world: World, whole: Instance, part: Instance) -> None:
    """``part`` is made while ``whole`` is set up, which is not done anew for a known object."""
    if world.effects is not None:
        world.parts.setdefault(id(whole), []).append(part)


def _own(world: World, known: Instance) -> None:
    """The callback made it, and what is part of it."""
    known.born = world.effects
    for part in world.parts.get(id(known), ()):
        _own(world, part)


def _site(world: World, cls: Class | Library, place: Place) -> object:
    return id(world.activity or world.current), cls, place, world.chain


def _both(
    before: list[Effect], again: list[Effect], name: Callable[[Effect], object]
) -> list[Effect]:
    replaced = {(effect.source, effect.chain, name(effect)) for effect in again}
    kept: list[Effect] = [d for d in before if (d.source, d.chain, name(d)) not in replaced]
    return sorted(kept + again, key=_way) if kept else again


def _way(effect: Access | Act | Blocking) -> list[Place]:
    """The calls that lead to it, for an order near to that of the text."""
    return [place for place in (*effect.chain, effect.source) if place is not None]
