"""Functions that code which is not scanned may call, on any thread, as values of a unit."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ros2cc_extract.extract.names import Names
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import RosWorld
from ros2cc_extract.extract.static.python.values.values import Bound, Class, Instance
from ros2cc_extract.extract.static.units.activities import facts_of
from ros2cc_extract.extract.static.units.torn_messages import pieces_of
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.model import Activity, ActivityKind


def handed_to_others(
    world: RosWorld, nodes: Sequence[Instance], node_names: Mapping[int, str], taken: Names
) -> tuple[Activity, ...]:
    """Those that touch data of the nodes of a unit."""
    found = []
    for state, name in world.handed_on:
        effects = state.effects
        touched = [node for node in nodes if id(node) in state.nodes]
        if not touched or not (effects.reads or effects.writes):
            continue
        facts = facts_of(state)
        receiver = state.target.receiver if isinstance(state.target, Bound) else None
        owner = receiver if isinstance(receiver, Instance) else None
        found.append(
            Activity(
                name=taken.take(facts.label),
                kind=ActivityKind.POOL if facts.coroutine else ActivityKind.THREAD,
                function=facts.function,
                node=node_names[id(touched[0])] if len(touched) == 1 else None,
                cls=owner.class_name if owner and isinstance(owner.cls, Class) else None,
                unresolved=Unknown(f'it is handed to {name}, which is not scanned', state.place),
                source=state.place,
                defined=facts.defined,
                reads=tuple(effects.reads),
                writes=tuple(effects.writes),
                pieces=pieces_of(state, world),
            )
        )
    return tuple(found)
