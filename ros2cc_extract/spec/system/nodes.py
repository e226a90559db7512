"""Resolve names from what the code says of a node and what the launch gives its process."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.node_graph import Awaited, Endpoint, EndpointKind, NodeGraph
from ros2cc_extract.spec.system.launched import Fact, Launched
from ros2cc_extract.spec.system.model import SystemAwaited, SystemEndpoint, SystemNode
from ros2cc_extract.spec.system.names import NAMESPACE, NODE, Naming, Remap, naming

_NO_NAME = '?'
_SERVICES = (EndpointKind.SERVICE, EndpointKind.CLIENT)
_CLIENTS = (EndpointKind.CLIENT, EndpointKind.ACTION_CLIENT)
_ACTIONS = (EndpointKind.ACTION_SERVER, EndpointKind.ACTION_CLIENT)
_PARAMETER = 'name follows from parameter'


def system_node(graph: NodeGraph, launched: Launched) -> SystemNode:
    """The node as the graph has it."""
    if graph.apart is not None:
        open_facts = (*launched.open, ('remappings', graph.apart))
        launched = replace(launched, name=graph.apart, namespace=graph.apart, open=open_facts)
    name: Fact = launched.name if launched.name is not None else graph.name
    namespace: Fact = launched.namespace if launched.namespace is not None else graph.namespace
    known = naming(
        graph.name if isinstance(graph.name, str) else _NO_NAME,
        namespace if isinstance(namespace, str) else '',
        _rules(launched),
    )
    if isinstance(name, str) and known.name == _NO_NAME:
        known = replace(known, name=name)
    if any(rule.old == NODE for rule in known.remaps):
        name = known.name
    if any(rule.old == NAMESPACE for rule in known.remaps):
        namespace = known.namespace
    why = next((fact for fact in (name, namespace) if isinstance(fact, Unknown)), None)
    opened = dict(reversed(launched.open))
    unknown = {p.name: p.value for p in launched.parameters if isinstance(p.value, Unknown)}
    endpoints = tuple(
        _endpoint(each, known, name, namespace, opened, unknown) for each in graph.endpoints
    )
    return SystemNode(
        name=known.full_name if why is None else why,
        own_name=graph.name,
        endpoints=endpoints,
        awaits=tuple(_awaited(graph.awaits, endpoints)),
        parameters=graph.parameters,
        declared=graph.declared,
        open=graph.open,
        source=graph.source,
        naming=known if why is None else None,
    )


def _awaited(
    awaits: Sequence[Awaited], endpoints: Sequence[SystemEndpoint]
) -> Iterator[SystemAwaited]:
    clients = {each.source: each for each in endpoints if each.kind in _CLIENTS}
    for each in awaits:
        client = clients.get(each.client)
        if client is not None:
            yield SystemAwaited(
                what=client.kind.what,
                name=client.name,
                source=each.place,
                answers=each.answers,
            )


def _rules(launched: Launched) -> Sequence[Remap]:
    """What stands on the command line of the process, in its order."""
    rules = list(launched.remaps)
    if isinstance(launched.name, str):
        rules.append(Remap(old=NODE, new=launched.name, source=launched.source))
    if isinstance(launched.namespace, str):
        rules.append(Remap(old=NAMESPACE, new=launched.namespace, source=launched.source))
    return rules


def _endpoint(
    endpoint: Endpoint,
    known: Naming,
    node: Fact,
    namespace: Fact,
    opened: dict[str, Unknown],
    unknown: dict[str, Unknown],
) -> SystemEndpoint:
    name, rule = _resolved(endpoint, known, node, namespace, opened, unknown)
    return SystemEndpoint(
        kind=endpoint.kind,
        name=name,
        written=endpoint.name,
        type=endpoint.type,
        remap=rule,
        source=endpoint.source,
        conditional=endpoint.conditional,
        assumed=endpoint.assumed,
        of=endpoint,
    )


def _resolved(
    endpoint: Endpoint,
    known: Naming,
    node: Fact,
    namespace: Fact,
    opened: dict[str, Unknown],
    unknown: dict[str, Unknown],
) -> tuple[Fact, Remap | None]:
    written = endpoint.name
    if isinstance(written, Unknown):
        return written, None
    if 'remappings' in opened:
        return opened['remappings'], None
    if 'parameters' in opened and (endpoint.assumed or '').startswith(_PARAMETER):
        return opened['parameters'], None
    for name, why in unknown.items():
        if (endpoint.assumed or '').startswith(f'{_PARAMETER} {name!r}'):
            return why, None
    if isinstance(namespace, Unknown) and not written.startswith('/'):
        return namespace, None
    if isinstance(node, Unknown) and written.startswith('~'):
        return node, None
    is_service = endpoint.kind in _SERVICES
    rule = known.rule_for(written, is_service=is_service)
    if rule is not None and endpoint.kind in _ACTIONS:
        # Each of the services and topics of an action has a name of its own; which of them a rule
        # for the action renames differs between releases of rcl.
        return Unknown('the name of an action is remapped', rule.source), rule
    return known.resolved(written, is_service=is_service), rule
