"""
Functions that code which is not scanned may call, or the system, as values of a unit.

Of a web server it is known that it calls them on other threads than those that spin, where other
threads spin than the one that runs it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from ros2cc_extract.extract.names import Names
from ros2cc_extract.extract.static.concurrency.machine.state import ActivityState
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import ExecutorState, RosWorld
from ros2cc_extract.extract.static.python.machine.recorded_effects import EffectLog
from ros2cc_extract.extract.static.python.values.values import Bound, Class, Instance
from ros2cc_extract.extract.static.units.activities import facts_of
from ros2cc_extract.extract.static.units.handler_locks import is_plain_lock
from ros2cc_extract.extract.static.units.torn_messages import pieces_of
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.effects import BY_CALLBACK, BY_NAME, Access, Waker
from ros2cc_extract.spec.model import Activity, ActivityKind, Executor

_AT_ANY_TIME = 'a signal comes at any time'
_NOT_SCANNED = 'it is handed to {}, which is not scanned'


def handed_to_others(
    world: RosWorld,
    nodes: Sequence[Instance],
    node_names: Mapping[int, str],
    taken: Names,
    executor: Executor,
    *,
    is_only: bool,
) -> tuple[tuple[Activity, bool], ...]:
    """
    Those that touch data of the nodes of a unit, or data that callbacks of any node may use.

    With each, whether it surely runs beside the callbacks.

    :param is_only: there is no other unit that they could belong to.
    """
    found = []
    for state, reason in (*_handed_on(world), *_handlers(world, executor)):
        effects = _as_held(state, world, executor)
        touched = [node for node in nodes if id(node) in state.nodes]
        is_of_unit = bool(touched) or is_only or not state.nodes
        if not is_of_unit or not (effects.reads or effects.writes):
            continue
        facts = facts_of(state)
        receiver = state.target.receiver if isinstance(state.target, Bound) else None
        owner = receiver if isinstance(receiver, Instance) else None
        handed = Activity(
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
            locks=tuple(effects.locks),
            pieces=pieces_of(state, world),
        )
        found.append((handed, _runs_beside(state, nodes, world)))
    return tuple(found)


def _runs_beside(state: ActivityState, nodes: Sequence[Instance], world: RosWorld) -> bool:
    """Whether a web server surely answers by it on another thread than those that spin."""
    spins = [each for each in world.spins.values() if not set(nodes).isdisjoint(each.nodes)]
    if id(state) not in world.answering or not world.servers or not spins:
        return False
    serving = {thread for thread, _ in world.servers}
    return all(
        isinstance(spin.executor.state, ExecutorState)
        and spin.executor.state.unknown is None
        and not spin.may_have_loop
        and spin.thread not in serving
        for spin in spins
    )


def that_answer(
    handed: Sequence[tuple[Activity, bool]], activities: Sequence[Activity], world: RosWorld
) -> Iterator[Activity]:
    """Those that surely run beside the callbacks, as the tasks of a pool which the server has."""
    main = next((each.name for each in activities if each.kind is ActivityKind.MAIN), None)
    in_main = next((place for thread, place in world.servers if thread == 0), None)
    starts = () if main is None or in_main is None else (Waker(by=main, source=in_main),)
    for each, runs_beside in handed:
        if runs_beside:
            beside = replace(each, kind=ActivityKind.POOL, unresolved=None)
            yield replace(beside, starts=starts, daemon=True)


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
