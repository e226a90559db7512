"""
Which callbacks of a unit belong together: a client and its server, an answer and its client.

Both are found by name, since that is all a specification has; a remapping is not visible here.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TypeVar

from ros2cc_extract.spec.effects import OUTSIDE, TIME, Blocking, Needs
from ros2cc_extract.spec.model import Callback, EntityKind

SERVER_KINDS = {
    EntityKind.CLIENT: EntityKind.SERVICE,
    EntityKind.ACTION_CLIENT: EntityKind.ACTION_SERVER,
}
"""What answers each kind of client."""
_NOBODY = frozenset((OUTSIDE, TIME))
_Part = TypeVar('_Part')


def is_client(callback: Callback) -> bool:
    """True for what takes the answers of a service or an action."""
    return callback.entity in SERVER_KINDS


def is_done_callback(callback: Callback) -> bool:
    """True for what runs when an answer has come."""
    return callback.entity is EntityKind.DONE_CALLBACK


def server_of(client: Callback, callbacks: Iterable[Callback]) -> Callback | None:
    """The one server of the client's name."""
    return _the_one(servers_of(client, callbacks))


def servers_of(client: Callback, callbacks: Iterable[Callback]) -> list[Callback]:
    """All servers of the client's name, which may all answer."""
    kind = SERVER_KINDS.get(client.entity) if client.entity else None
    if kind is None or not isinstance(client.key, str):
        return []
    return [c for c in callbacks if c.entity is kind and c.key == client.key]


def client_before(done: Callback, callbacks: Iterable[Callback]) -> Callback | None:
    """The one client of its node that takes the answer for which ``done`` is a done-callback."""
    return _the_one(_clients_before(done, callbacks))


def reachable(start: _Part, ahead: Mapping[_Part, set[_Part]]) -> set[_Part]:
    """Those that ``start`` needs, and that these need in turn; itself only in a cycle."""
    found: set[_Part] = set()
    left = [start]
    while left:
        new = ahead.get(left.pop(), set()) - found
        found |= new
        left += new
    return found


def asked_by(block: Blocking, callbacks: Iterable[Callback]) -> tuple[Callback, ...]:
    """
    List the clients by whose answers a wait without a time-out ends.

    It waits for one, or for a done-callback of one: nothing else sets its event.
    """
    if block.seconds is not None:
        return ()
    known = tuple(callbacks)
    by = {waker.by for waker in block.wakers}
    is_over = by <= _NOBODY if block.needs is Needs.ALL else by & _NOBODY
    direct = [each for each in known if each.name == block.on and is_client(each)]
    if direct or (by and is_over):
        return tuple(direct)
    ends = [each for each in known if each.name == block.on or each.name in by]
    found = {
        client.name: client
        for each in ends
        for client in ([each] if is_client(each) else _clients_before(each, known))
    }
    return tuple(found.values())


def _clients_before(done: Callback, callbacks: Iterable[Callback]) -> list[Callback]:
    if not is_done_callback(done) or not isinstance(done.key, str):
        return []
    name = (done.node, done.key)
    return [c for c in callbacks if is_client(c) and (c.node, c.key) == name]


def _the_one(found: Sequence[Callback]) -> Callback | None:
    return found[0] if len(found) == 1 else None
