"""What is done to an object that code waits for."""

from __future__ import annotations

from ros2cc_extract.extract.static.concurrency.machine.wake_operations import ResourceRef, Waking
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import RosWorld


def wakings_of(world: RosWorld, reference: ResourceRef) -> list[Waking]:
    """
    What is done to an object.

    A callback makes an object of its own each time; what ends the wait for one of them, from one
    place, ends it for all, where nothing is seen that ends it for this one.
    """
    known = world.wakings.get(reference.number)
    if known is not None:
        return known
    return [waking for number in reference.like for waking in world.wakings.get(number, ())]


def comes_last(waking: Waking, world: RosWorld) -> bool:
    """Whether the set-up does it when its last spin is over, and no callback runs any more."""
    is_behind = 0 < waking.spins == world.main_spins
    return waking.by is None and (waking.after_spin or is_behind)
