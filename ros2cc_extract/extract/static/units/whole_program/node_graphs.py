"""What each node of a program has in the graph, by the names that the code gives."""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.extract.static.libraries.rclpy.machine.assumptions import assumption
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import (
    EntityState,
    PublisherState,
    RosWorld,
)
from ros2cc_extract.extract.static.libraries.rclpy.values.declared_types import declared_in
from ros2cc_extract.extract.static.python.values.exclusive_paths import beyond
from ros2cc_extract.extract.static.python.values.values import (
    Const,
    Instance,
    Library,
    Mystery,
    Value,
)
from ros2cc_extract.extract.static.units.whole_program.qos_profiles import qos_of
from ros2cc_extract.extract.static.units.whole_program.start_up import awaits_of, waits_before
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.model import EntityKind, When
from ros2cc_extract.spec.node_graph import (
    CHANGE_STATE,
    CHANGE_STATE_TYPE,
    Endpoint,
    EndpointKind,
    NodeGraph,
)

_KINDS = {
    EntityKind.SUBSCRIPTION: EndpointKind.SUBSCRIPTION,
    EntityKind.SERVICE: EndpointKind.SERVICE,
    EntityKind.CLIENT: EndpointKind.CLIENT,
    EntityKind.ACTION_SERVER: EndpointKind.ACTION_SERVER,
    EntityKind.ACTION_CLIENT: EndpointKind.ACTION_CLIENT,
}
_INTERFACES = ('msg', 'srv', 'action')


def graphs_of(world: RosWorld, entry: str | None) -> Iterator[NodeGraph]:
    """The nodes of a run, in the order in which they are made."""
    for node in world.nodes:
        name, _ = _text(node.state.name)
        if node.state.ghost is not None or name is None:
            name = node.state.ghost or Unknown('no name of the node is known', node.place)
        namespace, _ = _text(node.state.namespace)
        more = node.state.more
        yield NodeGraph(
            name=name,
            namespace=namespace if namespace is not None else '',
            entry=entry,
            endpoints=tuple(_endpoints(node, world)),
            parameters=_parameters(node),
            declared=declared_in(node),
            awaits=tuple(awaits_of(node, world)),
            open=Unknown(*more[0]) if more else _cut(world),
            source=node.state.begun or node.place,
            apart=Unknown('the node has arguments of its own', node.place)
            if node.state.has_own_arguments
            else None,
        )


def _cut(world: RosWorld) -> Unknown | None:
    return next((Unknown(cut.reason, cut.place) for cut in world.cut), None)


def _endpoints(node: Instance, world: RosWorld) -> Iterator[Endpoint]:
    for publisher in world.publishers.values():
        if publisher.node is node:
            yield _of_publisher(publisher)
    for entity in world.by_node.get(id(node), ()):
        kind = _KINDS.get(entity.kind)
        if kind is not None and not entity.builtin:
            yield _of_entity(entity, kind, world)
    if any(e.kind is EntityKind.LIFECYCLE_SERVICE for e in world.by_node.get(id(node), ())):
        yield _of_life_cycle(node)


def _of_life_cycle(node: Instance) -> Endpoint:
    """
    The service that brings a node from one state of its life cycle to the next.

    Of its services this one is asked by programs, as the bring-up of a robot.
    """
    return Endpoint(
        kind=EndpointKind.SERVICE,
        name=CHANGE_STATE,
        type=CHANGE_STATE_TYPE,
        source=node.state.begun or node.place,
        conditional=node.state.changes_own_state,
    )


def _of_publisher(publisher: PublisherState) -> Endpoint:
    name, assumed = _text(publisher.topic)
    return Endpoint(
        kind=EndpointKind.PUBLISHER,
        name=name if name is not None else Unknown('no topic is known', publisher.place),
        type=_type(publisher.type),
        qos=qos_of(publisher.qos),
        source=publisher.place,
        conditional=bool(beyond(publisher.path, publisher.node.path)),
        assumed=assumed,
    )


def _of_entity(entity: EntityState, kind: EndpointKind, world: RosWorld) -> Endpoint:
    name, assumed = _text(entity.key)
    return Endpoint(
        kind=kind,
        name=name if name is not None else Unknown('no name is known', entity.place),
        type=_type(entity.type),
        qos=qos_of(entity.qos),
        source=entity.place,
        conditional=bool(beyond(entity.path, entity.node.path)) or entity.when is When.CALLBACK,
        assumed=assumed,
        after=waits_before(entity, world),
    )


def _text(value: Value | None) -> tuple[str | Unknown | None, str | None]:
    """A text, and the rule by which it was assumed."""
    if isinstance(value, Const):
        return (value.value, None) if isinstance(value.value, str) else (None, None)
    if not isinstance(value, Mystery):
        return (None, None) if value is None else (Unknown('computed at run time'), None)
    default = value.default
    if isinstance(default, Const) and isinstance(default.value, str):
        return default.value, assumption('name', value)
    label = f'{value.text}: ' if value.text else ''
    return Unknown(f'{label}{value.unknown.reason}', value.unknown.at), None


def _type(value: Value | None) -> str | None:
    """``package/kind/Name`` of what is imported as ``package.kind.Name``."""
    if not isinstance(value, Library):
        return None
    parts = value.name.split('.')
    is_interface = len(parts) > 2 and parts[1] in _INTERFACES
    return f'{parts[0]}/{parts[1]}/{parts[-1]}' if is_interface else None


def _parameters(node: Instance) -> tuple[str, ...] | None:
    """Names that the code declares or asks for; ``None`` where one could not be followed."""
    if node.state.takes_any_parameter:
        return None
    known = node.slots.get('__parameters__', {})
    return tuple(name for name in known if isinstance(name, str))
