"""
Which callbacks of the unit must run before a running callback can go on.

Source: rclpy 7.1.6, ``client.py`` (``call`` waits for an event that is set when the executor has
run the client), ``action/client.py``, ``timer.py`` (``Rate``); ``threading.Event.wait``;
``task.py`` (``await`` suspends the handler, ``callback_groups.py`` ends it only when it is done).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from ros2cc_extract.spec.model import Blocking, Callback, EntityKind, Spec

_SERVER = {
    EntityKind.CLIENT: EntityKind.SERVICE,
    EntityKind.ACTION_CLIENT: EntityKind.ACTION_SERVER,
}


@dataclass(frozen=True)
class NamedWait:
    """
    One wait of a callback.

    :param needed: name of the callback of the unit that must run before it ends.
    :param frees_thread: an ``await``, which holds the group alone.
    """

    needed: str
    frees_thread: bool


def waits_of(callback: Callback, spec: Spec) -> Iterator[NamedWait]:
    """List the waits that other callbacks end; one with a time-out ends by itself."""
    others = {other.name for other in spec.callbacks} - {callback.name}
    for block in callback.blocking:
        needed = block.on if isinstance(block.on, str) else None
        if needed in others and block.seconds is None and not _goes_on_alone(block):
            yield NamedWait(needed, block.call == 'await')


def _goes_on_alone(block: Blocking) -> bool:
    """A nested spin lets its thread serve others; waiting for a service only asks the graph."""
    return block.call.rpartition('.')[2].startswith(
        ('spin', 'wait_for_service', 'wait_for_server')
    )


def server_of(client: Callback, spec: Spec) -> str | None:
    """Name the one service of the unit that a client calls; remapping is not visible here."""
    kind = _SERVER.get(client.entity) if client.entity else None
    if kind is None or not isinstance(client.key, str):
        return None
    found = [c.name for c in spec.callbacks if c.entity is kind and c.key == client.key]
    return found[0] if len(found) == 1 else None
