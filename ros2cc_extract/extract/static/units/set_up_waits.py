"""
Waits of code that no callback runs: ``main``, constructors, functions nobody in sight calls.

They hold up nobody but the code itself, so that no model has them. Who ends each is told as for
the waits of callbacks; where that is a callback, its node must be spun meanwhile.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace

from ros2cc_extract.extract.static.concurrency.machine.state import ActivityState, SetUpWait
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import (
    EntityState,
    NodeState,
    RosWorld,
)
from ros2cc_extract.extract.static.python.machine.library_state import PlainState
from ros2cc_extract.extract.static.python.values.values import Instance
from ros2cc_extract.extract.static.units.executor import Unit
from ros2cc_extract.extract.static.units.waits import UnitWaits
from ros2cc_extract.extract.static.units.whole_program.unanswered_waits import spun_beside
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.effects import OUTSIDE, TIME, Blocking, Needs

_UNSPUN = 'nothing in sight spins {node} meanwhile'
_NOBODY = 'nothing in sight ends it'
_STAYS = 'the thread may loop forever'


def share_out(world: RosWorld, units: Sequence[Unit]) -> None:
    """Give each wait to the unit whose nodes it has to do with; the rest to the first."""
    homes = {id(node): unit for unit in units for node in unit.nodes}
    for wait in world.set_up.values():
        if wait.by is not None and not wait.by.is_executor:
            continue  # it is told as a wait of that thread
        touched = (homes.get(id(node)) for node in _nodes_of(wait, world))
        home = next((unit for unit in touched if unit is not None), units[0] if units else None)
        if home is not None:
            home.set_up.append(wait)


def _nodes_of(wait: SetUpWait, world: RosWorld) -> Iterator[object]:
    thing = wait.outside.client
    state = thing.state if isinstance(thing, Instance) else None
    of = state.of if isinstance(state, PlainState) and state.of is not None else thing
    if isinstance(of, Instance) and isinstance(of.state, EntityState):
        yield of.state.node
    if isinstance(of, Instance) and isinstance(of.state, NodeState):
        yield of
    yield from wait.outside.spun
    for waking in world.wakings.get(id(thing), ()):
        if isinstance(waking.by, EntityState):
            yield waking.by.node


def told(
    waits: Iterable[SetUpWait], world: RosWorld, named: UnitWaits, doers: Mapping[str, object]
) -> tuple[Blocking, ...]:
    """
    The waits by the names of their unit, with those who end them.

    :param doers: the callbacks and activities of the unit.
    """
    by_block = {id(wait.block): wait for wait in waits}
    found = named.of_set_up([wait.block for wait in by_block.values()])
    findings = {each.place for each in world.diagnostics if each.slug == 'nobody-spins'}
    return tuple(
        dict.fromkeys(
            _decided(block, by_block[id(raw)], world, doers, is_told=block.source in findings)
            for raw, block in found
        )
    )


def _decided(
    block: Blocking,
    wait: SetUpWait,
    world: RosWorld,
    doers: Mapping[str, object],
    *,
    is_told: bool,
) -> Blocking:
    """The wait with the reason why nobody knows whether it ends, where that is so."""
    is_open = block.seconds is None and block.escapes is None and not is_told
    is_open = is_open and not block.initial  # of a semaphore: it is free
    if not is_open or any(waker.by in (OUTSIDE, TIME) for waker in block.wakers):
        return block
    why = _why_open(block, wait, world, doers)
    return block if why is None else replace(block, escapes=Unknown(why, block.source))


def _why_open(
    block: Blocking, wait: SetUpWait, world: RosWorld, doers: Mapping[str, object]
) -> str | None:
    served = {id(node) for node in (*wait.outside.spun, *spun_beside(wait.outside, world))}
    reasons = [_why_not(doers.get(waker.by), wait, served) for waker in block.wakers]
    open_ones = [reason for reason in reasons if reason is not None]
    is_met = len(open_ones) < len(reasons) if block.needs is not Needs.ALL else not open_ones
    if reasons and is_met:
        return None
    if wait.uncalled:
        return f'nothing in sight calls {wait.uncalled}'
    return open_ones[0] if open_ones else _NOBODY


def _why_not(doer: object, wait: SetUpWait, served: set[int]) -> str | None:
    """Why it is not known whether ``doer`` does what ends the wait; ``None`` where it does."""
    if isinstance(doer, ActivityState):
        return _STAYS if wait.is_late and doer.endless is not None else None
    if not isinstance(doer, EntityState) or id(doer.node) in served:
        return None
    return _UNSPUN.format(node=doer.node.hint or doer.node.class_name)
