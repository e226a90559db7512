"""Waits for a message by ``wait_for_message``, noted for when all was followed."""

from __future__ import annotations

from dataclasses import dataclass

from ros2cc_extract.extract.static.python.machine.world import (
    EntityState,
    NodeState,
    OutsideWait,
    World,
)
from ros2cc_extract.extract.static.python.values.values import Instance, Value, options_of
from ros2cc_extract.places import Place

CALL = 'wait_for_message'


@dataclass(frozen=True, eq=False)
class MessageWait:
    """
    A message of ``node`` is waited for.

    :param by: the callback that waits; ``None`` for a thread or ``main``.
    :param thread: which one it is, as ``World.thread`` counts them.
    """

    node: Instance
    outside: OutsideWait
    by: EntityState | None
    thread: int
    has_limit: bool


def note(world: World, node: Value | None, place: Place, *, has_limit: bool) -> None:
    """Remember a wait for a message."""
    nodes = [each for each in options_of(node) if isinstance(each, Instance)] if node else []
    if len(nodes) != 1 or not isinstance(nodes[0].state, NodeState) or world.retelling:
        return
    by = world.current if world.in_callback else None
    begun = None if world.in_thread or world.open_loops else len(world.spins)
    outside = OutsideWait(
        CALL, None, place, world.in_thread, over=tuple(world.over), path=world.path, begun=begun
    )
    is_uncalled = by is None and not world.is_program
    if not is_uncalled:
        wait = MessageWait(nodes[0], outside, by, world.thread, has_limit)
        world.message_waits.append(wait)
