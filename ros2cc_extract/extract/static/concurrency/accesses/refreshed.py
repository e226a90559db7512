"""
Statements that store a value whatever was stored before: they do not rest on a test of it.

``self.refresh()`` stores what the parameter says now. Where a run has called it without a
question, and does so again behind a test of what it found, the second store stands for itself
like the first.
"""

from __future__ import annotations

from ros2cc_extract.extract.static.concurrency.machine.state import ConcurrentWorld
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.effects import Access


def is_known(world: ConcurrentWorld, name: str, place: Place) -> bool:
    """Whether the run has surely stored ``name`` by this statement before, without asking."""
    before = world.effects.stored_anyway.get((name, place)) if world.effects is not None else None
    return before is not None and world.path[: len(before)] == before


def note_stored(world: ConcurrentWorld, write: Access) -> None:
    """It is stored, because of what was read of it or not."""
    if world.effects is None or write.source is None or write.rests:
        return
    if not is_known(world, write.name, write.source):
        world.effects.stored_anyway[write.name, write.source] = world.path
