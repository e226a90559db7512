"""Threads of the program's own that go one by one, as a test lets each begin."""

from __future__ import annotations

from ros2cc_extract.extract.static.concurrency.machine.state import ActivityState, KeptIn
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import (
    EntityState,
    GroupState,
    RosWorld,
)
from ros2cc_extract.spec.model import GroupType


def go_in_turn(world: RosWorld, one: ActivityState | None, other: ActivityState | None) -> bool:
    """Whether neither begins before the other has ended."""
    if one is None or other is None:
        return False
    return any(kept in (other.alone or {}) for kept in _kept_alone(world, one))


def _kept_alone(world: RosWorld, state: ActivityState) -> list[KeptIn]:
    """The attributes that keep it and no other thread meanwhile."""
    return [
        kept
        for kept in state.alone or {}
        if kept not in world.unguarded and _is_one_piece(world, kept)
    ]


def _is_one_piece(world: RosWorld, kept: KeptIn) -> bool:
    """Whether no code can start one between the test and the start of another."""
    starts = [start for each in world.activities for start in (each.alone or {}).get(kept, ())]
    locks = [{lock for lock, _ in holds} for _, holds in starts]
    groups = {_exclusive_group(by) for by, _ in starts}
    return bool(set.intersection(*locks)) or (len(groups) == 1 and None not in groups)


def _exclusive_group(doer: object) -> int | None:
    if not isinstance(doer, EntityState):
        return None
    group = doer.group.state
    is_one = isinstance(group, GroupState) and group.type is GroupType.EXCLUSIVE
    return id(doer.group) if is_one and not group.groupless and not group.unresolved else None
