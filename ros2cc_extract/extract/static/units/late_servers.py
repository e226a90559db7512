"""
Servers that the set-up makes only behind its own wait for them.

``while not client.wait_for_service(timeout_sec=1.0): …`` in a constructor whose next line makes
that service, or in a node that ``main`` makes before the one which offers it: nothing else in the
program can offer it, so that the wait never ends. Measured on rclpy 7.1.6: it never does, while a
service that the same node has made before is there at once, without a spin.
"""

from __future__ import annotations

from collections.abc import Iterator
from enum import Enum

from ros2cc_extract.diagnostics import Diagnostic, RelatedPlace, Severity
from ros2cc_extract.extract.static.concurrency.machine.state import ActivityState, SetUpWait
from ros2cc_extract.extract.static.concurrency.waits.outside_waits import in_words
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import (
    EntityState,
    NodeState,
    RosWorld,
)
from ros2cc_extract.extract.static.python.values.exclusive_paths import exclusive
from ros2cc_extract.extract.static.python.values.values import Const, Instance
from ros2cc_extract.extract.static.units.wakers.late_offers import is_same_name
from ros2cc_extract.extract.static.units.whole_program.start_up import client_of
from ros2cc_extract.extract.static.units.whole_program.unanswered_waits import spun_beside
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.client_server_pairs import SERVER_KINDS
from ros2cc_extract.spec.model import ActivityKind, EntityKind, When

_WHAT = {EntityKind.SERVICE: 'the service', EntityKind.ACTION_SERVER: 'the action server'}


class _Order(Enum):
    """When a server is made, as seen from a wait for it."""

    BEFORE = 'before'
    BEHIND = 'behind'
    UNSURE = 'unsure'


@dataclass(frozen=True)
class LateServers:
    """
    What a wait of the set-up waits for, all of which is made behind it or perhaps is.

    :param is_sure: it is behind the wait whatever branches are taken and whoever else is there.
    """

    wait: SetUpWait
    servers: tuple[EntityState, ...]
    is_sure: bool

    @property
    def why_open(self) -> str:
        """Why nobody knows whether the wait ends."""
        first = self.servers[0]
        if not _is_main(first.maker) and isinstance(first.maker, ActivityState):
            return f'whether another thread has made {_named(first)} is not known ({first.place})'
        return f'{_named(first)} may be made only behind the wait ({first.place})'

    def diagnostic(self) -> Diagnostic:
        """Tell that the wait never ends."""
        first, block = self.servers[0], self.wait.block
        return Diagnostic(
            severity=Severity.ERROR,
            slug='nobody-spins',
            place=block.source or Place(''),
            message=f'{in_words(block.call)} waits for {_named(first)}, which the program itself '
            'makes only behind this wait: it waits forever',
            help='make the server before the wait, or wait where the program has one already',
            related=tuple(
                RelatedPlace(each.place, f'{_named(each)} is made here') for each in self.servers
            ),
        )


def late_servers(wait: SetUpWait, world: RosWorld) -> LateServers | None:
    """The servers that a wait is for, where none of them is there by then for certain."""
    client = client_of(wait)
    if client is None or not is_endless_for_main(wait, world):
        return None
    servers = list(_servers_of(client, wait, world))
    orders = {_order(server, wait, world) for server in servers}
    if not servers or _Order.BEFORE in orders:
        return None
    is_certain = not wait.outside.path and not any(map(_has_branches, servers))
    is_certain = is_certain and orders == {_Order.BEHIND} and all(map(_is_in_sight, world.nodes))
    return LateServers(wait, tuple(servers), is_certain)


def is_endless_for_main(wait: SetUpWait, world: RosWorld) -> bool:
    """Whether the thread of the set-up stands there until somebody is there."""
    block = wait.block
    is_of_main = _is_main(wait.by) and not wait.outside.in_thread and wait.uncalled is None
    is_endless = block.seconds is None or block.source in world.asked_until
    return is_of_main and is_endless and not wait.in_handler and not wait.is_late


def _servers_of(client: EntityState, wait: SetUpWait, world: RosWorld) -> Iterator[EntityState]:
    """Those of its name, if not made on other branches than the wait, or by what nobody calls."""
    kind = SERVER_KINDS[client.kind]
    for each in world.entities:
        is_same = each.kind is kind and is_same_name(client, each)
        is_met = each.when is not When.LATER and not exclusive(each.path, wait.outside.path)
        if is_same and is_met:
            yield each


def _order(server: EntityState, wait: SetUpWait, world: RosWorld) -> _Order:
    if server.when is When.CALLBACK and isinstance(server.maker, EntityState):
        served = list(spun_beside(wait.outside, world))
        is_served = any(server.maker.node is each for each in (*wait.outside.spun, *served))
        return _Order.UNSURE if is_served or wait.outside.begun != 0 else _Order.BEHIND
    if server.when is not When.START or not _is_main(server.maker):
        return _Order.UNSURE
    place = list(world.set_up.values()).index(wait)
    return _Order.BEHIND if server.after > place else _Order.BEFORE


def _is_main(doer: object) -> bool:
    """Whether the thread of the set-up does it, be it beside an executor that another spins."""
    return doer is None or (isinstance(doer, ActivityState) and doer.kind is ActivityKind.MAIN)


def _has_branches(server: EntityState) -> bool:
    """Whether a branch may lead past its making."""
    return any(branch >= 0 for _, branch in server.path)


def _is_in_sight(node: Instance) -> bool:
    """Whether all that it has is seen."""
    state = node.state
    return isinstance(state, NodeState) and state.ghost is None and not state.more


def _named(server: EntityState) -> str:
    key = server.key.value if isinstance(server.key, Const) else ''
    return f'{_WHAT[server.kind]} {key!r}'
