"""
What a callback holds from its begin: flags that its maker has handed over to it.

The execute callback of an action server holds what the goal callback holds wherever it accepts;
where that has only found a flag down, the execute callback may put it up.
"""

from __future__ import annotations

from dataclasses import replace

from ros2cc_extract.extract.static.concurrency.accesses.flag_locks import has_waited
from ros2cc_extract.extract.static.libraries.rclpy.machine.machine import RosMachine
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import EntityState, RosWorld
from ros2cc_extract.extract.static.python.values.values import NONE, Call, Value, options_of
from ros2cc_extract.spec.effects import FLAG
from ros2cc_extract.spec.model import EntityKind


def call_holding(
    machine: RosMachine, entity: EntityState, callback: Value, arguments: Call
) -> Value:
    """Call what an entity runs, holding what was handed over to it."""
    world = machine.world
    served = (entity.node, entity.place)
    world.still_down = frozenset()
    if entity.kind is EntityKind.ACTION_EXECUTE:
        world.held = world.admitted.get(served, ())
        world.still_down = world.open_to.get(served, frozenset())
    else:
        world.held = entity.held or ()
    result = machine.run_if_coroutine(machine.call(callback, arguments), entity.place)
    if callback in options_of(entity.goal_callback or NONE):
        _note_admission(world)
        world.admitted[served] = tuple(held for held in world.accepted if held.endswith(FLAG))
        is_one_piece = not entity.defers and not has_waited(world)
        world.open_to[served] = world.found_down if is_one_piece else frozenset()
    return result


def _note_admission(world: RosWorld) -> None:
    """What the goal callback has read, and turned goals down for."""
    effects, names = world.effects, world.reading.refusing
    if effects is not None and names:
        effects.reads[:] = [replace(r, admits=r.name in names) for r in effects.reads]


def hand_over(world: RosWorld, to: EntityState) -> None:
    """What a callback makes runs after it, and holds what it holds."""
    if world.effects is not None:
        held = tuple(lock for lock in world.held if lock.endswith(FLAG))
        to.held = held if to.held is None else tuple(lock for lock in to.held if lock in held)
        world.held = tuple(lock for lock in world.held if lock not in held)
