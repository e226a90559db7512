"""
What the first run of a callback does, where only another run of its own could end its wait.

Whether a run waits or ends waits of others may depend on attributes that only the callback
itself changes. Its first run finds in them what the set-up has stored: if that run waits, and no
other run of the callback can begin meanwhile, nothing ever ends the wait.
"""

from __future__ import annotations

from ros2cc_extract.extract.static.concurrency.machine.wake_operations import ResourceRef
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import (
    EntityState,
    GroupState,
    RosWorld,
)
from ros2cc_extract.extract.static.python.machine.recorded_effects import EffectLog, way_of
from ros2cc_extract.extract.static.python.values.values import Const, Instance, Value
from ros2cc_extract.extract.static.scan.callback_runs import run_once_more
from ros2cc_extract.extract.static.scan.ros_interpreter import RosInterpreter
from ros2cc_extract.spec.effects import Blocking
from ros2cc_extract.spec.model import GroupType

Stored = dict[tuple[Instance, str], Value]


def stored_by_set_up(world: RosWorld) -> Stored:
    """The constants that attributes of nodes hold before anything is spun."""
    return {
        (node, name): value
        for node in world.nodes
        for name, value in node.slots.items()
        if isinstance(value, Const)
    }


def follow_first_runs(machine: RosInterpreter, stored: Stored) -> None:
    """Note which waits first runs surely wait, of those that only later runs could end."""
    for entity in machine.world.entities:
        waits = [block for block in _blocking(entity) if _ends_by_itself(block, entity, machine)]
        if waits and _is_serial(entity):
            log = _first_run(machine, entity, stored)
            entity.surely_waits |= {way_of(block) for block in waits if _is_sure(block, log)}


def _blocking(entity: EntityState) -> list[Blocking]:
    return entity.effects.blocking if entity.effects is not None else []


def _is_serial(entity: EntityState) -> bool:
    group = entity.group.state
    is_known = isinstance(group, GroupState) and group.unresolved is None
    return is_known and group.type is GroupType.EXCLUSIVE and entity.count == 1


def _ends_by_itself(block: Blocking, entity: EntityState, machine: RosInterpreter) -> bool:
    """Whether only the callback that waits is seen to end the wait."""
    reference = block.resource
    if not isinstance(reference, ResourceRef) or not reference.is_kept or not block.conditional:
        return False
    wakings = machine.world.wakings.get(reference.number, ())
    mine = [waking for waking in wakings if waking.word in reference.ended_by]
    is_in_sight = reference.number not in machine.world.given
    return bool(mine) and is_in_sight and all(waking.by is entity for waking in mine)


def _first_run(machine: RosInterpreter, entity: EntityState, stored: Stored) -> EffectLog:
    world = machine.world
    others = _written_by_others(world, entity)
    own = {
        at: value for at, value in stored.items() if f'{at[0].class_name}.{at[1]}' not in others
    }
    before = {(node, name): node.slots.get(name) for node, name in own}
    for (node, name), value in own.items():
        machine.store.write(node, name, value)
    world.settled_now = frozenset(own)
    try:
        return run_once_more(machine, entity)
    finally:
        world.settled_now = frozenset()
        for (node, name), held in before.items():
            if held is not None:
                machine.store.write(node, name, held)


def _written_by_others(world: RosWorld, entity: EntityState) -> set[str]:
    logs = [each.effects for each in (*world.entities, *world.activities) if each is not entity]
    return {access.name for log in logs if log is not None for access in log.writes}.union(
        world.other_writes, world.writes_beside
    )


def _is_sure(block: Blocking, first: EffectLog) -> bool:
    """Whether the first run waits there on all branches, and has not ended that wait before."""
    for place, met in enumerate(first.blocking):
        if way_of(met) == way_of(block) and not met.conditional:
            reference = block.resource
            woken = first.woken.get(reference.number) if isinstance(reference, ResourceRef) else 0
            return woken is None or woken > place
    return False
