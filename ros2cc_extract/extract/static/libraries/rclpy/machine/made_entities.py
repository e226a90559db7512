"""What a callback makes at one place is one entity, made again and again."""

from __future__ import annotations

from ros2cc_extract.extract.static.concurrency.accesses.lost_notifications import note_made
from ros2cc_extract.extract.static.libraries.rclpy.machine.machine import RosMachine
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import EntityState, RosWorld
from ros2cc_extract.extract.static.python.objects.allocation_sites import argument_token
from ros2cc_extract.extract.static.python.values.values import Const, Instance, Value
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.model import EntityKind, When


def _site(node: Instance, kind: EntityKind, key: Value | None, place: Place) -> object:
    text = key.value if isinstance(key, Const) else None
    return (id(node), kind, place, text)


def remember_entity(machine: RosMachine, made: Instance) -> None:
    """Keep an entity for ``entity_made_before``."""
    entity = made.state
    site = _site(entity.node, entity.kind, entity.key, entity.place)
    machine.world.made_in_callbacks[site] = made


def entity_made_before(
    machine: RosMachine,
    node: Instance,
    kind: EntityKind,
    key: Value | None,
    place: Place,
    callback: Value | None = None,
) -> Instance | None:
    """What a callback makes at one place is one entity, made again and again."""
    world = machine.world
    known = world.made_in_callbacks.get(_site(node, kind, key, place))
    if known is None:
        return None
    is_again = world.when is When.CALLBACK and known.state.when is When.CALLBACK
    if (
        not is_again
        and not world.second_pass
        and not _made_while_missing(world, known.state, key, callback)
    ):
        return None
    note_made(world, kind.value, place)
    return known


def _made_while_missing(
    world: RosWorld, known: EntityState, key: Value | None, callback: Value | None
) -> bool:
    """Whether code without a known caller has made ``known`` here, behind the same test."""
    tests = {place for place, _ in world.path} & world.missing
    return (
        world.when in (When.LATER, When.CALLBACK)
        and known.when is When.LATER
        and known.callback == callback
        and argument_token(known.key) == argument_token(key)
        and any(place in tests for place, _ in known.path)
    )
