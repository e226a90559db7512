"""
What the set-up does for a wait before anything else runs.

An event that it sets stays set, unless it is cleared. What it puts or gives back is there for the
first waits only.
"""

from __future__ import annotations

from collections.abc import Sequence

from ros2cc_extract.extract.static.concurrency.machine.wake_operations import ResourceRef, Waking
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import EntityState, RosWorld
from ros2cc_extract.extract.static.python.machine.path_facts import Word
from ros2cc_extract.extract.static.units.wakers.operations import (
    comes_last,
    is_of_other_data,
)
from ros2cc_extract.extract.static.units.wakers.uncertain_wakers import RECURRING
from ros2cc_extract.source_locations import Unknown

_GIVEN = frozenset({Word.PUT, Word.RELEASE, Word.GET, Word.DONE})


def is_of_set_up(waking: Waking, world: RosWorld) -> bool:
    """Whether it comes before anything else runs."""
    return waking.by is None and waking.uncalled is None and not comes_last(waking, world)


def ends_for_good(waking: Waking, reference: ResourceRef, world: RosWorld) -> bool:
    """Whether, after ``waking`` in the set-up, nothing waits any more."""
    is_set = waking.word is Word.SET and reference.is_kept and not waking.conditional
    return is_set and reference.number not in world.cleared and is_of_set_up(waking, world)


def why_open(mine: Sequence[Waking], reference: ResourceRef, world: RosWorld) -> Unknown | None:
    """Why the set-up may end one wait and not the next one, or what notifies speaks of others."""
    if not mine and is_of_other_data(world, reference):
        return Unknown('no code that notifies it changes what the wait asks for', reference.made)
    early = [waking for waking in mine if is_of_set_up(waking, world)]
    if any(ends_for_good(waking, reference, world) for waking in early):
        return None
    for waking in early:
        is_set = waking.word is Word.SET and reference.is_kept
        if is_set and _is_surely_cleared(mine, reference, world):
            continue
        if is_set or (waking.word in _GIVEN and not waking.is_counted):
            what = 'cleared again' if is_set else 'used up'
            reason = f'what the set-up does to end it may be {what}'
            return Unknown(reason, waking.place)
    return None


def _is_surely_cleared(mine: Sequence[Waking], reference: ResourceRef, world: RosWorld) -> bool:
    """
    Whether a callback that comes again and again clears the event on all its branches.

    It may come before the wait, and the wait then ends as if nothing had set it. One that sets it
    too leaves it as it is, and one that waits for it itself clears it only behind a set.
    """
    setters = [waking.by for waking in mine if not is_of_set_up(waking, world)]
    return bool(setters) and any(
        isinstance(by, EntityState)
        and by.kind in RECURRING
        and by not in setters
        and not _waits_for(by, reference)
        for by, _ in world.surely_cleared.get(reference.number, ())
    )


def _waits_for(doer: EntityState, reference: ResourceRef) -> bool:
    blocks = doer.effects.blocking if doer.effects is not None else []
    resources = [block.resource for block in blocks]
    return any(isinstance(r, ResourceRef) and r.number == reference.number for r in resources)
