"""
Which callbacks of the unit must run before a running callback can go on.

Source: rclpy 7.1.6, ``client.py`` (``call`` waits for an event that is set when the executor has
run the client), ``action/client.py``, ``timer.py`` (``Rate``); ``threading.Event.wait``.
"""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.spec.model import Blocking, Callback, EntityKind, Spec

_SERVER = {
    EntityKind.CLIENT: EntityKind.SERVICE,
    EntityKind.ACTION_CLIENT: EntityKind.ACTION_SERVER,
}


def needs_of(callback: Callback, spec: Spec) -> Iterator[str]:
    """Name the callbacks it waits for, one per wait; a wait with a time-out ends by itself."""
    others = {other.name for other in spec.callbacks} - {callback.name}
    for block in callback.blocking:
        if _holds_its_thread(block) and block.seconds is None and block.on in others:
            yield str(block.on)


def _holds_its_thread(block: Blocking) -> bool:
    """An ``await`` frees the thread, a nested spin lets it serve others."""
    return block.call != 'await' and not block.call.rpartition('.')[2].startswith('spin')


def server_of(client: Callback, spec: Spec) -> str | None:
    """Name the one service of the unit that a client calls; remapping is not visible here."""
    kind = _SERVER.get(client.entity) if client.entity else None
    if kind is None or not isinstance(client.key, str):
        return None
    found = [c.name for c in spec.callbacks if c.entity is kind and c.key == client.key]
    return found[0] if len(found) == 1 else None
