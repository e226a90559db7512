"""
Services that only a callback makes: a callback that waits until one is there waits for that one.

A service that the set-up makes is there when the callbacks run. Sources: rclpy 7.1.6 and 9.1.2,
``client.py`` (``wait_for_service`` asks the graph and sleeps in between).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from ros2cc_extract.extract.static.libraries.rclpy.machine.state import (
    EntityState,
    NodeState,
    RosWorld,
)
from ros2cc_extract.extract.static.python.values.values import Const, Instance
from ros2cc_extract.spec.client_server_pairs import SERVER_KINDS
from ros2cc_extract.spec.effects import Blocking, Needs, Waker
from ros2cc_extract.spec.model import When

_PRESENCE = ('wait_for_service', 'wait_for_server')


def offered_late(
    world: RosWorld, raw: Blocking, named: Blocking, names: Mapping[int, str]
) -> Blocking | None:
    """Give a wait for what callbacks make, with those as its wakers; ``None`` for any other."""
    if raw.call not in _PRESENCE or raw.seconds is not None:
        return None
    number = getattr(raw.on, 'number', None)
    client = next((each for each in world.entities if id(each) == number), None)
    kind = SERVER_KINDS.get(client.kind) if client is not None else None
    if client is None or kind is None:
        return None
    servers = [e for e in world.entities if e.kind is kind and is_same_name(client, e)]
    makers = [server.maker for server in servers if server.when is When.CALLBACK]
    by = [names.get(id(maker)) for maker in makers if isinstance(maker, EntityState)]
    if not servers or len(by) < len(servers) or None in by:
        return None
    wakers = (
        Waker(by=str(name), source=server.place, conditional=_is_on_a_branch(server))
        for name, server in zip(by, servers, strict=True)
    )
    key = client.key.value if isinstance(client.key, Const) else named.on
    return replace(
        named,
        on=by[0],
        resource=f'{kind.value.replace("_", " ")} {key}',
        wakers=tuple(dict.fromkeys(wakers)),
        needs=Needs.ONCE,
    )


def _is_on_a_branch(server: EntityState) -> bool:
    return any(branch >= 0 for _, branch in server.path)


def is_same_name(client: EntityState, server: EntityState) -> bool:
    """Whether a server answers what a client asks, as far as names tell."""
    one, other = client.key, server.key
    if not isinstance(one, Const) or not isinstance(other, Const) or one.value != other.value:
        return False
    if client.node is server.node:
        return True
    name = str(one.value)
    return name.startswith('/') or (
        not name.startswith('~') and _namespace(client.node) == _namespace(server.node)
    )


def _namespace(node: Instance) -> object:
    state = node.state
    namespace = state.namespace if isinstance(state, NodeState) else None
    if namespace is None:
        return ''
    return str(namespace.value).strip('/') if isinstance(namespace, Const) else namespace
