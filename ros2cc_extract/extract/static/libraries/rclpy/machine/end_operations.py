"""
Notes of what callbacks and threads end.

``ends_while_served.py`` reports what happens to the code that they serve.
"""

from __future__ import annotations

import ast

from ros2cc_extract.extract.static.libraries.rclpy.machine.machine import RosMachine
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import (
    End,
    EntityState,
    ExecutorState,
    NodeEnd,
)
from ros2cc_extract.extract.static.python.machine.world import RECENT
from ros2cc_extract.extract.static.python.values.exclusive_paths import is_behind
from ros2cc_extract.extract.static.python.values.values import Instance, Mystery, Value, options_of
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.model import When

SHUTDOWN, SHUTDOWN_EXECUTOR = 'rclpy.shutdown', 'executor.shutdown'
DESTROY_NODE, REMOVE_NODE, DESTROY = 'destroy_node', 'remove_node', 'destroy'
CANCEL = 'cancel'
DESTROY_PUBLISHER, PUBLISHED = 'destroy_publisher', 'publish'
RAISES = 'raise'
USED = 'used when rclpy was shut down'
OF_RATE = 'rclpy.create_rate'
# Of base classes, and of generators; a Ctrl-C is not for an executor.
_NO_END = frozenset({'NotImplementedError', 'StopIteration', 'KeyboardInterrupt'})


def note_use(machine: RosMachine, what: str, place: Place) -> None:
    """The middleware is used; it fails where the callback has surely shut rclpy down before."""
    world = machine.world
    current = world.current
    at = current.node.slots.get(_slot(current)) if current is not None else None
    if current is not None and isinstance(at, Mystery) and at.unknown.at:
        world.ends.append(End(USED, current.node, current, at.unknown.at, f'{what} ({place})'))


def note_published(machine: RosMachine, publisher: Value, place: Place) -> None:
    """A message goes out by a publisher, which nobody may destroy meanwhile."""
    if isinstance(publisher, Instance):
        latest = machine.world.ends[-RECENT:]
        if not any(
            (end.kind, end.what, end.place) == (PUBLISHED, publisher, place) for end in latest
        ):
            note_end(machine, PUBLISHED, publisher, place)


def note_shutdown(machine: RosMachine, place: Place) -> None:
    """The callback that is followed shuts rclpy down."""
    current = machine.world.current
    if current is not None:
        machine.store.write(
            current.node, _slot(current), Mystery(Unknown('rclpy is shut down', place))
        )
    note_end(machine, SHUTDOWN, None, place)


def note_end(
    machine: RosMachine,
    kind: str,
    what: Instance | EntityState | None,
    place: Place,
    text: str = '',
    *,
    is_limited: bool = False,
) -> None:
    """A callback, or a thread of the program's own, ends something."""
    world = machine.world
    if world.second_pass:
        return
    doer = world.activity or (world.current if world.in_callback else None)
    if doer is not None and not world.shutting_down and not world.after_spin:
        behind = world.effects.behind if world.effects is not None else None
        over = tuple(one for one in world.over if is_behind(one.path, world.path))
        joins = tuple(join for join in world.timed_joins if is_behind(join.path, world.path))
        world.ends.append(
            End(kind, what, doer, place, text, behind, world.held, over, joins, is_limited)
        )


def note_node_ended(machine: RosMachine, node: Instance, place: Place) -> None:
    """A node is destroyed, by a callback, a thread, or the main program."""
    world = machine.world
    note_end(machine, DESTROY_NODE, node, place)
    is_main = world.effects is None and world.activity is None and world.when is When.START
    if is_main and not world.in_thread and not world.second_pass:
        ended = {id(over.what) for over in world.over} | {id(j.thread) for j in world.timed_joins}
        world.node_ends.append(NodeEnd(node, place, frozenset(ended)))


def note_raised(machine: RosMachine, error: ast.expr, place: Place) -> None:
    """A callback raises, and nothing in it catches that."""
    called = error.func if isinstance(error, ast.Call) else error
    name = called.attr if isinstance(called, ast.Attribute) else getattr(called, 'id', '')
    if name[:1].isupper() and name not in _NO_END and not machine.world.caught:
        note_end(machine, RAISES, None, place, name)


def _slot(entity: EntityState) -> str:
    return f'__shut_down__{entity.number}'


def executor_of(node: Instance) -> Instance | None:
    """The one executor that serves a node in the end."""
    owner = node.slots.get('__owner__')
    known = options_of(owner) if isinstance(owner, Value) else ()
    found = [each for each in known if isinstance(each, Instance)]
    is_known = len(found) == 1 and isinstance(found[0].state, ExecutorState)
    return found[0] if is_known and found[0].state.unknown is None else None
