"""What is done to an object that code waits for."""

from __future__ import annotations

from collections.abc import Sequence

from ros2cc_extract.extract.static.concurrency.machine.wake_operations import ResourceRef, Waking
from ros2cc_extract.extract.static.concurrency.waits.uncalled_wakers import (
    data_is_written_elsewhere,
)
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import RosWorld
from ros2cc_extract.extract.static.python.machine.path_facts import Word
from ros2cc_extract.extract.static.python.machine.recorded_effects import Doer


def wakings_of(world: RosWorld, reference: ResourceRef) -> list[Waking]:
    """
    What is done to an object.

    A callback makes an object of its own each time; what ends the wait for one of them, from one
    place, ends it for all, where nothing is seen that ends it for this one. What notifies of other
    data than a wait for a condition asks for does not end it.
    """
    found = _all_of(world, reference)
    names = reference.guard.until if reference.guard is not None else frozenset()
    if not names or _may_be_passed_on(world, reference, names, found):
        return found
    return [w for w in found if w.word is not Word.SET or _may_speak_of(names, w.by)]


def is_of_other_data(world: RosWorld, reference: ResourceRef) -> bool:
    """Whether a condition is notified, but of nothing that the wait asks for."""
    found = (w for w in _all_of(world, reference) if w.word in reference.ended_by)
    return reference.guard is not None and bool(reference.guard.until) and any(found)


def gives_one_of_several(reference: ResourceRef, mine: Sequence[Waking]) -> bool:
    """Whether a wait for a condition asks for several things, which different code brings."""
    guard = reference.guard
    if guard is None or not guard.is_of_several:
        return False
    brought = {
        frozenset((w.name, w.item) for w in waking.by.effects.writes if w.name in guard.names)
        for waking in mine
        if isinstance(waking.by, Doer) and waking.by.effects is not None
    }
    return len(brought) > 1


def _all_of(world: RosWorld, reference: ResourceRef) -> list[Waking]:
    known = world.wakings.get(reference.number)
    if known is not None:
        return known
    return [waking for number in reference.like for waking in world.wakings.get(number, ())]


def _may_be_passed_on(
    world: RosWorld, reference: ResourceRef, names: frozenset[str], wakings: list[Waking]
) -> bool:
    """Whether code that notifies of nothing, and does not wait itself, may write the data."""
    if data_is_written_elsewhere(world, names) or names & world.writes_beside.keys():
        return True
    notifying = {id(waking.by) for waking in wakings if waking.word is Word.SET}
    others = (d for d in (*world.entities, *world.activities) if id(d) not in notifying)
    return any(_writes_some(names, d) and not _waits_for(reference, d) for d in others)


def _may_speak_of(names: frozenset[str], by: object) -> bool:
    return not isinstance(by, Doer) or _writes_some(names, by)


def _writes_some(names: frozenset[str], doer: Doer) -> bool:
    return doer.effects is not None and any(each.name in names for each in doer.effects.writes)


def _waits_for(reference: ResourceRef, doer: Doer) -> bool:
    resources = (each.resource for each in (doer.effects.blocking if doer.effects else ()))
    return any(isinstance(r, ResourceRef) and r.number == reference.number for r in resources)


def comes_last(waking: Waking, world: RosWorld) -> bool:
    """Whether the set-up does it when its last spin is over, and no callback runs any more."""
    is_behind = 0 < waking.spins == world.main_spins
    return waking.by is None and (waking.after_spin or is_behind)
