"""From recordings of hooked processes to a system: what ran, under the names that it had."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise

from ros2cc_extract.extract.live.recordings.collect import specs_of
from ros2cc_extract.extract.live.recordings.recording import (
    RecordedEntity,
    RecordedNode,
    Recording,
)
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.identifiers import mend
from ros2cc_extract.spec.model import EntityKind
from ros2cc_extract.spec.node_graph import Endpoint, EndpointKind
from ros2cc_extract.spec.system.builtin_names import is_builtin
from ros2cc_extract.spec.system.launched import RECORDED, Launched
from ros2cc_extract.spec.system.model import Process, System, SystemEndpoint, SystemNode
from ros2cc_extract.spec.system.names import expanded, full_name, read_remap

_KINDS = {
    EntityKind.SUBSCRIPTION: EndpointKind.SUBSCRIPTION,
    EntityKind.SERVICE: EndpointKind.SERVICE,
    EntityKind.CLIENT: EndpointKind.CLIENT,
    EntityKind.ACTION_SERVER: EndpointKind.ACTION_SERVER,
    EntityKind.ACTION_CLIENT: EndpointKind.ACTION_CLIENT,
}
_ACTIONS = (EndpointKind.ACTION_SERVER, EndpointKind.ACTION_CLIENT)
_REMAP = ('-r', '--remap')


def recorded_system(recordings: Sequence[Recording], name: str) -> System:
    """
    One process for each recording that holds a node.

    :param name: of the folder they are in.
    """
    taken: dict[str, int] = {}
    processes = tuple(_process(each, taken) for each in recordings if each.nodes)
    return System(name=name, processes=processes, sources=tuple(each.file for each in recordings))


def _process(recording: Recording, taken: dict[str, int]) -> Process:
    place = Place(recording.file)
    main = next((word for word in recording.argv[1:] if word.endswith('.py')), '')
    stem = (main or ' '.join(recording.argv[:2])).rpartition('/')[2].removesuffix('.py')
    number = taken[stem] = taken.get(stem, 0) + 1
    return Process(
        name=stem if number == 1 else f'{stem}_{number}',
        launched=Launched(kind=RECORDED, source=place, command=recording.argv),
        nodes=tuple(_nodes(recording, place)),
        units=specs_of(recording),
    )


def _nodes(recording: Recording, place: Place) -> Iterator[SystemNode]:
    for node in recording.nodes:
        if node.name is None:
            why = Unknown('it was gone before its name could be read', place)
            yield SystemNode(name=why, own_name=why, source=place)
            continue
        has_publishers = node.publishers is not None
        yield SystemNode(
            name=full_name(node.namespace or '/', node.name),
            own_name=mend(node.name),
            endpoints=tuple(_endpoints(node, recording)),
            parameters=None,
            open=None if has_publishers else Unknown('publishers were not recorded', place),
            source=place,
        )


def _endpoints(node: RecordedNode, recording: Recording) -> Iterator[SystemEndpoint]:
    assert node.name is not None
    own = full_name(node.namespace or '/', node.name)
    for publisher in node.publishers or ():
        name = publisher.resolved_key or publisher.key
        if name is not None and not is_builtin(EndpointKind.PUBLISHER, name, own):
            of = Endpoint(
                kind=EndpointKind.PUBLISHER,
                name=publisher.key or name,
                type=publisher.type,
                qos=publisher.qos,
            )
            yield _of(of, name)
    for entity in recording.entities:
        kind = _KINDS.get(EntityKind(entity.kind))
        if kind is None or entity.node != node.number or entity.builtin:
            continue
        written = entity.key or Unknown('its name was not recorded', entity.created)
        of = Endpoint(
            kind=kind,
            name=written,
            type=entity.type,
            qos=entity.qos,
            source=entity.created,
            conditional=entity.in_callback,
        )
        yield _of(of, entity.resolved_key or _resolved(entity, kind, node, recording))


def _of(endpoint: Endpoint, name: str | Unknown) -> SystemEndpoint:
    return SystemEndpoint(
        kind=endpoint.kind,
        name=name,
        written=endpoint.name,
        type=endpoint.type,
        source=endpoint.source,
        conditional=endpoint.conditional,
        of=endpoint,
    )


def _resolved(
    entity: RecordedEntity, kind: EndpointKind, node: RecordedNode, recording: Recording
) -> str | Unknown:
    """rclpy keeps the name of an action as it is written; of others it knows the resolved one."""
    if entity.key is None:
        return Unknown('its name was not recorded', entity.created)
    if kind in _ACTIONS and _has_remaps(recording.argv):
        return Unknown('the name of an action may be remapped', entity.created)
    return expanded(entity.key, node.namespace or '/', node.name or '')


def _has_remaps(argv: Sequence[str]) -> bool:
    rules = (read_remap(word) for flag, word in pairwise(argv) if flag in _REMAP)
    return any(rule is not None and not rule.old.startswith('__') for rule in rules)
