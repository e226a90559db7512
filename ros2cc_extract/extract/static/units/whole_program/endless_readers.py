"""
Subscriptions of a loop of asyncio that never let the loop go on.

The task of a subscription takes the next message at once where there is one, and gives way to
others only where its callback awaits, or if it has none. Source: rclpy 10.0.10 and 11.0.0,
``experimental/async_subscription.py`` (``_messages``, ``_run``).
"""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.diagnostics import Diagnostic, Severity
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import (
    EntityState,
    GroupState,
    RosWorld,
)
from ros2cc_extract.extract.static.python.machine.recorded_effects import EffectLog
from ros2cc_extract.extract.static.python.values.values import Const
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.model import EntityKind, GroupType


def note_endless_readers(world: RosWorld) -> None:
    """Report callbacks that in each run send themselves the next message."""
    for entity in world.entities:
        if _gives_no_way(entity):
            for place in _sends_to_itself(entity):
                world.diagnostics.append(_endless(entity, place))


def _gives_no_way(entity: EntityState) -> bool:
    """Whether it reads message after message; where runs are concurrent, none has begun then."""
    group = entity.group.state
    is_serial = isinstance(group, GroupState) and group.type is GroupType.EXCLUSIVE
    is_read = entity.kind is EntityKind.SUBSCRIPTION and entity.is_on_loop and is_serial
    blocks = (entity.effects or EffectLog()).blocking
    return is_read and not any(block.suspends for block in blocks)


def _sends_to_itself(entity: EntityState) -> Iterator[Place]:
    key = entity.key.value if isinstance(entity.key, Const) else None
    log = entity.effects or EffectLog()
    for act in log.publishes:
        _, may_skip = log.written.get((act.name, act.source), (None, True))
        if act.name == key and not may_skip and act.source is not None:
            yield act.source


def _endless(entity: EntityState, place: Place) -> Diagnostic:
    key = entity.key.value if isinstance(entity.key, Const) else ''
    return Diagnostic(
        severity=Severity.WARNING,
        slug='endless-reader',
        place=place,
        message=f'each message of {key!r} is answered by another one on the same topic, and '
        'nothing is awaited in between: the loop never gets to anything else',
        help='await something in the callback, as `await asyncio.sleep(0)`, or publish from a '
        'timer',
    )
