"""Waits for a message by ``wait_for_message``, noted for when all was followed."""

from __future__ import annotations

from ros2cc_extract.extract.static.concurrency.machine.state import OutsideWait
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import (
    MessageWait,
    NodeState,
    RosWorld,
)
from ros2cc_extract.extract.static.python.values.values import Instance, Value, options_of
from ros2cc_extract.source_locations import Place

CALL = 'wait_for_message'


def note(world: RosWorld, node: Value | None, place: Place, *, has_limit: bool) -> None:
    """Remember a wait for a message."""
    nodes = [each for each in options_of(node) if isinstance(each, Instance)] if node else []
    if len(nodes) != 1 or not isinstance(nodes[0].state, NodeState) or world.second_pass:
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
