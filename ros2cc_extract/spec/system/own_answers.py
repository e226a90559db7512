"""A process that asks itself because a rule of its launch gives two of its services one name."""

from __future__ import annotations

from dataclasses import replace

from ros2cc_extract.spec.client_server_pairs import SERVER_KINDS, is_done_callback
from ros2cc_extract.spec.model import Callback, EntityKind, Spec
from ros2cc_extract.spec.system.model import SystemEndpoint, SystemNode


def with_own_answers(unit: Spec, nodes: tuple[SystemNode, ...]) -> Spec:
    """
    Call each client as the service or action of the same unit that has its name in the graph.

    The unit is judged by the names that its code says, and would take it for one of another
    process.
    """
    known = _resolved(unit, nodes)
    servers = {
        (callback.entity, known[callback.name]): callback.key
        for callback in unit.callbacks
        if callback.entity in SERVER_KINDS.values() and callback.name in known
    }
    changed = {
        callback.name: servers[SERVER_KINDS[callback.entity], known[callback.name]]
        for callback in unit.callbacks
        if callback.entity in SERVER_KINDS
        and (SERVER_KINDS[callback.entity], known.get(callback.name)) in servers
    }
    renamed = {
        (each.node, each.key): changed[each.name]
        for each in unit.callbacks
        if each.name in changed
    }
    callbacks = tuple(
        replace(each, key=renamed[each.node, each.key])
        if each.name in changed or (is_done_callback(each) and (each.node, each.key) in renamed)
        else each
        for each in unit.callbacks
    )
    return unit if callbacks == unit.callbacks else replace(unit, callbacks=callbacks)


def _resolved(unit: Spec, nodes: tuple[SystemNode, ...]) -> dict[str, str]:
    """The names in the graph of the callbacks that a rule has renamed, or that may meet them."""
    ends = {
        (node.own_name, end.source): end for node in nodes for end in node.endpoints if end.source
    }
    found: dict[str, str] = {}
    for callback in unit.callbacks:
        end = ends.get((str(callback.node), callback.source)) if callback.source else None
        if end is not None and _is_of(end, callback) and isinstance(end.name, str):
            found[callback.name] = end.name
    return found


def _is_of(end: SystemEndpoint, callback: Callback) -> bool:
    kinds = {
        EntityKind.CLIENT: 'client',
        EntityKind.SERVICE: 'service',
        EntityKind.ACTION_CLIENT: 'action_client',
        EntityKind.ACTION_SERVER: 'action_server',
    }
    kind = kinds.get(callback.entity) if callback.entity is not None else None
    return kind == end.kind.value and end.written == callback.key
