"""
Statements that store a value whatever was stored before: they do not rest on a test of it.

``self.refresh()`` stores what the parameter says now. Where a run has called it without a
question, and does so again behind a test of what it found, the second store stands for itself
like the first. An object that is made anew each time is no such value: that of another is lost.
"""

from __future__ import annotations

from ros2cc_extract.extract.static.concurrency.machine.state import ConcurrentWorld
from ros2cc_extract.extract.static.python.values.values import (
    Const,
    Library,
    Module,
    Mystery,
    Value,
    options_of,
)
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.effects import Access


def is_known(world: ConcurrentWorld, name: str, place: Place) -> bool:
    """Whether the run has surely stored ``name`` by this statement before, without asking."""
    before = world.effects.stored_anyway.get((name, place)) if world.effects is not None else None
    if before is None or world.path[: len(before)] != before:
        return False
    stored = world.reading.stored
    return stored is not None and all(_is_data(world, each) for each in options_of(stored))


def _is_data(world: ConcurrentWorld, value: Value) -> bool:
    """Whether equal values are as good as one."""
    if isinstance(value, Mystery):
        return value.unknown not in world.outside_objects
    return isinstance(value, (Const, Library, Module))


def note_stored(world: ConcurrentWorld, write: Access) -> None:
    """It is stored, because of what was read of it or not."""
    if world.effects is None or write.source is None or write.rests:
        return
    before = world.effects.stored_anyway.get((write.name, write.source))
    if before is None or world.path[: len(before)] != before:
        world.effects.stored_anyway[write.name, write.source] = world.path
