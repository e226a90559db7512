"""Notes of what callbacks and threads end; ``ends.py`` tells what becomes of whom they serve."""

from __future__ import annotations

from ros2cc_extract.extract.static.machine import Machine
from ros2cc_extract.extract.static.values import Instance, Mystery
from ros2cc_extract.extract.static.world import End, EntityState
from ros2cc_extract.places import Place, Unknown

SHUTDOWN, SHUTDOWN_EXECUTOR = 'rclpy.shutdown', 'executor.shutdown'
DESTROY_NODE, REMOVE_NODE, DESTROY = 'destroy_node', 'remove_node', 'destroy'
USED = 'used when rclpy was shut down'


def note_use(machine: Machine, what: str, place: Place) -> None:
    """The middleware is used; it fails where the callback has surely shut rclpy down before."""
    world = machine.world
    current = world.current
    at = current.node.slots.get(_slot(current)) if current is not None else None
    if current is not None and isinstance(at, Mystery) and at.unknown.at:
        world.ends.append(End(USED, current.node, current, at.unknown.at, f'{what} ({place})'))


def note_shutdown(machine: Machine, place: Place) -> None:
    """The callback that is followed shuts rclpy down."""
    current = machine.world.current
    if current is not None:
        machine.store.write(
            current.node, _slot(current), Mystery(Unknown('rclpy is shut down', place))
        )
    note_end(machine, SHUTDOWN, None, place)


def note_end(
    machine: Machine, kind: str, what: Instance | EntityState | None, place: Place
) -> None:
    """A callback, or a thread of the program's own, ends something."""
    world = machine.world
    if world.retelling:
        return
    doer = world.activity or (world.current if world.in_callback else None)
    if doer is not None and not world.shutting_down and not world.after_spin:
        world.ends.append(End(kind, what, doer, place))


def _slot(entity: EntityState) -> str:
    return f'__shut_down__{entity.number}'
