"""
``wait_for_message`` on a node that is spun meanwhile, and what takes the message then.

It makes a subscription of the node, in its default group, and waits for it by a wait set of its
own; an executor that spins the node meanwhile sees that subscription too. The first takes
the message: the other one finds none, and ``wait_for_message`` gives ``(False, None)`` at once, or
waits for the next one. Sources: rclpy 7.1.6 and 9.1.2, ``wait_for_message.py``, ``executors.py``
(``_wait_for_ready_callbacks``, ``_take_subscription``: not while the group is closed).
"""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.diagnostics import Diagnostic, Severity
from ros2cc_extract.extract.static.libraries.rclpy.machine.end_operations import executor_of
from ros2cc_extract.extract.static.libraries.rclpy.machine.message_waits import CALL
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import (
    GroupState,
    MessageWait,
    RosWorld,
    Spin,
)
from ros2cc_extract.extract.static.python.values.exclusive_paths import exclusive
from ros2cc_extract.extract.static.python.values.values import Instance
from ros2cc_extract.extract.static.units.whole_program.unanswered_waits import spins_beside
from ros2cc_extract.spec.model import GroupType


def note_taken(world: RosWorld) -> None:
    """Report, after all was followed, waits whose message the node's executor may take."""
    found = (_diagnostic(wait) for wait in world.message_waits if _is_taken(wait, world))
    world.diagnostics.extend(dict.fromkeys(found))


def _is_taken(wait: MessageWait, world: RosWorld) -> bool:
    if wait.by is None:
        return any(_goes_on(wait, world))
    executor, own = executor_of(wait.node), executor_of(wait.by.node)
    if executor is None or own is None:
        return False
    if executor is not own:
        return any(spin.for_ever or spin.repeated for spin in _of(executor, world))
    group, state = wait.node.state.default_group, executor.state
    is_known = isinstance(group.state, GroupState) and group.state.unresolved is None
    is_shut = wait.by.group is group and group.state.type is GroupType.EXCLUSIVE
    is_pool = state.threads != 1 and state.threads_unresolved is None
    return is_known and is_pool and not is_shut and state.unresolved is None


def _of(executor: Instance, world: RosWorld) -> Iterator[Spin]:
    return (spin for spin in world.spins.values() if spin.executor is executor)


def _goes_on(wait: MessageWait, world: RosWorld) -> Iterator[bool]:
    """Whether other threads spin the node while this one waits."""
    ended = _spins_before_its_end(wait, world)
    spins = list(world.spins.values())
    for spin, nodes in spins_beside(wait.outside, world):
        is_other = spin.thread != wait.thread and (spin.for_ever or spin.repeated)
        is_other = is_other and (ended is None or spins.index(spin) < ended)
        is_other = is_other and not exclusive(spin.path, wait.outside.path)
        yield is_other and any(node is wait.node for node in nodes)


def _spins_before_its_end(wait: MessageWait, world: RosWorld) -> int | None:
    """How many spins have begun when the program has joined the thread that waits, if it does."""
    runners = [r for each in world.activities if each.thread == wait.thread for r in each.runners]
    joins = (over.spins for over in world.over if over.what in runners and not over.path)
    return min(joins, default=None)


def _diagnostic(wait: MessageWait) -> Diagnostic:
    who = 'another thread spins'
    if wait.by is not None:
        who = 'another thread of its executor serves'
    or_else = '' if wait.has_limit else ', or waits for the next one, forever if none comes'
    return Diagnostic(
        severity=Severity.WARNING,
        slug='message-taken',
        place=wait.outside.place,
        message=f'{CALL} creates a subscription of a node that {who} meanwhile and that may take '
        f'the message first: then {CALL} returns False{or_else}',
        help='wait with a node of its own that nobody spins, or subscribe and wait for an event '
        'that the callback sets',
    )
