"""Functions that code which is not scanned may call, or the system, as values of a unit."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from ros2cc_extract.extract.names import Names
from ros2cc_extract.extract.static.concurrency.machine.state import ActivityState
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import RosWorld
from ros2cc_extract.extract.static.python.machine.recorded_effects import EffectLog
from ros2cc_extract.extract.static.python.values.values import Bound, Class, Instance
from ros2cc_extract.extract.static.units.activities import facts_of
from ros2cc_extract.extract.static.units.handler_locks import is_plain_lock
from ros2cc_extract.extract.static.units.torn_messages import pieces_of
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.effects import BY_CALLBACK, BY_NAME, Access
from ros2cc_extract.spec.model import Activity, ActivityKind, Executor

_AT_ANY_TIME = 'a signal comes at any time'
_NOT_SCANNED = 'it is handed to {}, which is not scanned'


def handed_to_others(
    world: RosWorld,
    nodes: Sequence[Instance],
    node_names: Mapping[int, str],
    taken: Names,
    executor: Executor,
) -> tuple[Activity, ...]:
    """Those that touch data of the nodes of a unit, or of no node."""
    found = []
    for state, reason in (*_handed_on(world), *_handlers(world, executor)):
        effects = _as_held(state, world, executor)
        touched = [node for node in nodes if id(node) in state.nodes]
        if not (touched or not state.nodes) or not (effects.reads or effects.writes):
            continue
        facts = facts_of(state)
        receiver = state.target.receiver if isinstance(state.target, Bound) else None
        owner = receiver if isinstance(receiver, Instance) else None
        found.append(
            Activity(
                name=taken.take(facts.label),
                kind=ActivityKind.POOL if facts.coroutine else ActivityKind.THREAD,
                function=facts.function,
                node=node_names[id(touched[0])] if len(touched) == 1 else None,
                cls=owner.class_name if owner and isinstance(owner.cls, Class) else None,
                unresolved=Unknown(reason, state.place),
                source=state.place,
                defined=facts.defined,
                reads=tuple(effects.reads),
                writes=tuple(effects.writes),
                pieces=pieces_of(state, world),
            )
        )
    return tuple(found)


def _handed_on(world: RosWorld) -> Iterator[tuple[ActivityState, str]]:
    return (
        (state, name if name.endswith((BY_NAME, BY_CALLBACK)) else _NOT_SCANNED.format(name))
        for state, name in world.handed_on
    )


def _handlers(world: RosWorld, executor: Executor) -> Iterator[tuple[ActivityState, str]]:
    """
    Handlers of signals, which interrupt the main thread in the middle of a callback.

    Those of a loop of asyncio run between its callbacks.
    """
    for handler in world.signal_handlers:
        if handler.interrupts or executor.in_thread:
            yield handler, _AT_ANY_TIME


def _as_held(state: ActivityState, world: RosWorld, executor: Executor) -> EffectLog:
    """What it does; a handler takes a lock that its own thread holds once more, if it can."""
    is_inside = state.interrupts and not executor.in_thread and len(executor.threads) == 1
    if not is_inside:
        return state.effects

    def bare(access: Access) -> Access:
        return replace(
            access, locks=tuple(lock for lock in access.locks if is_plain_lock(lock, world))
        )

    reads, writes = map(bare, state.effects.reads), map(bare, state.effects.writes)
    return replace(state.effects, reads=list(reads), writes=list(writes))
