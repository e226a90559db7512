"""The activities of one unit: which they are, and their values in the specification."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from ros2cc_extract.extract.static.concurrency.machine.state import ActivityState
from ros2cc_extract.extract.static.concurrency.machine.wake_operations import ResourceRef
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import (
    EntityState,
    ExecutorState,
    RosWorld,
)
from ros2cc_extract.extract.static.python.machine.recorded_effects import EffectLog
from ros2cc_extract.extract.static.python.values.values import Bound, Class, Instance
from ros2cc_extract.extract.static.units.callback_names import FunctionFacts, describe
from ros2cc_extract.extract.static.units.waits import UnitWaits
from ros2cc_extract.extract.static.units.wakers.endless_threads import starts_itself
from ros2cc_extract.spec.effects import Access, Act, Waker
from ros2cc_extract.spec.model import Activity, ActivityKind

_MAIN = 'main'


def activities_of(
    world: RosWorld, nodes: Sequence[Instance], entities: Iterable[EntityState], *, is_only: bool
) -> list[ActivityState]:
    """
    Find those that have to do with a unit, in the order of their start.

    :param is_only: there is no other unit that they could belong to.
    """
    entities = tuple(entities)
    left = [state for state in world.activities if not _is_executor(state)]
    if is_only:
        return left
    doers = {id(entity) for entity in entities}
    touched = {id(node) for node in nodes}
    things = {number for entity in entities for number in _things(world, entity)}
    names = {name for entity in entities for name in _shared_names(entity.effects)}
    found: list[ActivityState] = []
    while True:
        more = [
            state
            for state in left
            if state.nodes & touched
            or state.things & things
            or not names.isdisjoint(_shared_names(state.effects))
            or any(id(start.by) in doers for start in state.starts)
            or any(id(runner) in things for runner in state.runners)
        ]
        if not more:
            return sorted(found, key=world.activities.index)
        left = [state for state in left if state not in more]
        found += more
        doers |= {id(state) for state in more}
        things |= {number for state in more for number in state.things}
        names |= {name for state in more for name in _shared_names(state.effects)}


def _shared_names(effects: EffectLog | None) -> Iterable[str]:
    """The data and the locks that code has to do with."""
    log = effects or EffectLog()
    yield from (access.name for access in (*log.reads, *log.writes))
    yield from (lock.name for lock in log.locks if isinstance(lock.name, str))


def _things(world: RosWorld, entity: EntityState) -> Iterable[int]:
    """What a callback waits on, or ends waits on."""
    for block in (entity.effects or EffectLog()).blocking:
        if isinstance(block.resource, ResourceRef):
            yield block.resource.number
    for number, wakings in world.wakings.items():
        if any(waking.by is entity for waking in wakings):
            yield number


def _is_executor(state: ActivityState) -> bool:
    """Whether it only sets up and spins an executor, or is a main program that does nothing."""
    effects = state.effects
    does = (
        effects.blocking or effects.reads or effects.writes or effects.locks or effects.publishes
    )
    if state.kind is ActivityKind.MAIN:
        return not does
    return state.is_executor or (state.serves and not does)


def facts_of(state: ActivityState) -> FunctionFacts:
    """What its function says of itself."""
    if state.kind is ActivityKind.MAIN:
        return FunctionFacts(_MAIN)
    return describe(state.target, state.place)


def own_spins(state: ActivityState, world: RosWorld, nodes: Sequence[Instance]) -> tuple[Act, ...]:
    """
    Where ``main`` runs the callbacks of ``nodes``, if nothing else does.

    Then it stands still while they run, and they do while it goes on: by its one thread, or in
    a spin forever; its pool runs nothing before.
    """
    spins = [spin for spin in world.spins.values() if not set(nodes).isdisjoint(spin.nodes)]
    executors = {spin.executor for spin in spins if not spin.for_ever}
    executors |= {each.executor for each in world.inside_spins}
    is_alone = (
        state.kind is ActivityKind.MAIN
        and not any(spin.in_thread or spin.from_callback for spin in spins)
        and all(node.state.nested is None for node in nodes)
        and all(_has_one_thread(executor.state) for executor in executors)
    )
    return tuple(
        Act(name=spin.how, source=spin.place, chain=chain)
        for spin in spins
        if is_alone
        for chain in spin.chains
    )


def _has_one_thread(executor: ExecutorState) -> bool:
    is_known = executor.unknown is None and executor.unresolved is None
    return is_known and executor.threads == 1 and executor.threads_unresolved is None


def activity(
    state: ActivityState,
    names: dict[int, str],
    waits: UnitWaits,
    pieces: tuple[Access, ...],
    spins: tuple[Act, ...],
) -> Activity:
    """The value of ``state`` in the specification."""
    facts = facts_of(state)
    receiver = state.target.receiver if isinstance(state.target, Bound) else None
    owner = receiver if isinstance(receiver, Instance) else None
    effects = state.effects
    return Activity(
        name=names[id(state)],
        kind=state.kind,
        function=facts.function,
        node=names.get(id(owner)) or _only_node(state, names),
        cls=owner.class_name if owner is not None and isinstance(owner.cls, Class) else None,
        starts=() if starts_itself(state) else tuple(_starts(state, names, waits)),
        count=state.count,
        conditional=_is_conditional(state),
        daemon=state.daemon,
        on_loop=state.on_loop,
        loops=state.loops or waits.rounds.get(id(state), starts_itself(state)),
        ends_first=state.ends_first,
        unresolved=facts.unresolved,
        source=state.place,
        defined=facts.defined,
        blocking=waits.of(state),
        reads=tuple(effects.reads),
        writes=tuple(effects.writes),
        locks=tuple(effects.locks),
        publishes=waits.messages_of(state),
        changes=tuple(effects.changes),
        spins=spins,
        pieces=pieces,
    )


def _only_node(state: ActivityState, names: dict[int, str]) -> str | None:
    """The node of all that a thread touches, whose function is no method of a node."""
    if state.kind is ActivityKind.MAIN or len(state.nodes) != 1:
        return None
    return names.get(next(iter(state.nodes)))


def _takes_turns(state: ActivityState, starter: object) -> bool:
    """Whether it begins only when the code that starts it has ended: both have one thread."""
    if isinstance(starter, EntityState):
        return state.turns is not None and starter.node.state.loop == state.turns
    return state.turns is not None and getattr(starter, 'turns', None) is state.turns


def _is_conditional(state: ActivityState) -> bool:
    """Whether a branch of the code that starts it may skip the start."""
    starts = [start for start in state.starts if start.by is not None]
    return all(start.conditional for start in starts) if starts else bool(state.path)


def _starts(state: ActivityState, names: dict[int, str], waits: UnitWaits) -> Iterable[Waker]:
    for start in state.starts:
        name = names.get(id(start.by)) if start.by is not None else None
        if name is not None:
            yield Waker(
                by=name,
                source=start.place,
                after=None if _takes_turns(state, start.by) else waits.after(start),
                conditional=start.conditional,
            )
