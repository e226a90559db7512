"""
Nested spins of nodes that nothing else serves: they end by what comes from outside, or by time.

A helper node that has its own clients (``BasicNavigator`` of Nav2) is in no executor: code that
asks it spins it until the answer has come. Nothing of the unit runs meanwhile, and nothing of the
unit is needed, where no callback of the helper waits or takes a lock itself.

Source: rclpy 7.1.6 and 9.1.2, ``__init__.py`` (``spin_until_future_complete`` adds the node to the
global executor, and takes out again what it has added), ``executors.py`` (it goes round until the
future is done or the time is over). Where two such spins overlap, the first that is over takes the
node away from the other.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import chain

from ros2cc_extract.extract.static.libraries.rclpy.machine.state import (
    EntityState,
    InsideSpin,
    NodeState,
    RosWorld,
)
from ros2cc_extract.extract.static.python.values.values import NONE, Const, Instance, options_of
from ros2cc_extract.extract.static.python.values.values import Value as AnyValue
from ros2cc_extract.extract.static.units.wakers.data_writers import Doer
from ros2cc_extract.extract.static.units.whole_program.double_spins import may_overlap
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.client_server_pairs import SERVER_KINDS
from ros2cc_extract.spec.effects import OUTSIDE, TIME, Blocking, Waker

FOR_FUTURE = 'spin for future'
_TAKEN_AWAY = 'another spin of that executor may take the node away'


def of_spin_aside(world: RosWorld, raw: Blocking, named: Blocking, doer: Doer) -> Blocking | None:
    """Give a nested spin, or the wait for its future, with what ends it; ``None`` for others."""
    ender = _ender_of_spin(world, raw, doer)
    if ender is not None:
        return replace(named, wakers=(ender,))
    spins = _spins_at(world, raw, doer)
    is_shared = any(_is_aside(spin, world) and _is_shared(spin, world) for spin in spins)
    if not is_shared or raw.seconds is not None:
        return None
    return replace(named, on=Unknown(_TAKEN_AWAY, raw.source))


def _ender_of_spin(world: RosWorld, raw: Blocking, doer: Doer) -> Waker | None:
    """What ends a nested spin, or the wait for its future; ``None`` if that is not known."""
    spins = _spins_at(world, raw, doer)
    if not spins or not all(_is_aside(spin, world) for spin in spins):
        return None
    if any(_is_shared(spin, world) for spin in spins) and not _is_over_in_time(raw, doer):
        return None
    by = raw if raw.call == FOR_FUTURE else _future_of(raw, doer)
    if by is raw or (by is None and raw.seconds is None):
        return _ender(raw, spins, world)
    # It is over when its future is, or its time; what ends that is found there.
    is_ended = by is None or _ender(by, spins, world) is not None
    return Waker(by=TIME, source=raw.source) if is_ended else None


def _ender(raw: Blocking, spins: list[InsideSpin], world: RosWorld) -> Waker | None:
    if raw.seconds is not None:
        return Waker(by=TIME, source=raw.source)
    if all(spin.is_for_library for spin in spins):
        return Waker(by=OUTSIDE, source=raw.source)
    clients = [
        each for spin in spins for each in _entities(spin, world) if id(each) == _number(raw)
    ]
    is_outside = bool(clients) and all(_is_answered_outside(each, world) for each in clients)
    return Waker(by=OUTSIDE, source=raw.source) if is_outside else None


def _spins_at(world: RosWorld, raw: Blocking, doer: Doer) -> list[InsideSpin]:
    return [s for s in world.inside_spins if s.entity is doer and s.place == raw.source]


def _is_over_in_time(raw: Blocking, doer: Doer) -> bool:
    future = _future_of(raw, doer)
    return raw.seconds is not None or (future is not None and future.seconds is not None)


def _is_shared(spin: InsideSpin, world: RosWorld) -> bool:
    """Whether another callback, or another run, may spin that executor at the same time."""
    alike = (each for each in world.inside_spins if each.executor is spin.executor)
    return any(
        may_overlap(spin, each) for each in alike if each is spin or each.entity is not spin.entity
    )


def _number(raw: Blocking) -> int | None:
    return getattr(raw.on, 'number', None)


def _future_of(raw: Blocking, doer: Doer) -> Blocking | None:
    """The wait for a future that the spin at this place stands for."""
    waits = doer.effects.blocking if doer.effects is not None else ()
    here = (each for each in waits if (each.source, each.chain) == (raw.source, raw.chain))
    return next((each for each in here if each.call == FOR_FUTURE), None)


def _is_aside(spin: InsideSpin, world: RosWorld) -> bool:
    """Whether nothing else spins that executor, or serves its nodes, and none of these waits."""
    goes_on = any(
        other.executor is spin.executor and (other.for_ever or other.repeated)
        for other in world.spins.values()
    )
    nodes = tuple(_nodes(spin, world))
    if goes_on or not nodes or not all(_is_only_there(node, spin) for node in nodes):
        return False
    return all(_runs_on(each) for each in _entities(spin, world))


def _nodes(spin: InsideSpin, world: RosWorld) -> Iterator[Instance]:
    """Those that others put there meanwhile are served, too."""
    alike = (each for each in world.inside_spins if each.executor is spin.executor)
    yield from dict.fromkeys(node for each in alike for node in each.nodes)


def _is_only_there(node: Instance, spin: InsideSpin) -> bool:
    state = node.state
    if not isinstance(state, NodeState) or state.ghost is not None or state.more:
        return False
    owner = node.slots.get('__owner__')
    owners = options_of(owner) if isinstance(owner, AnyValue) else ()
    return all(each in (spin.executor, NONE) for each in owners)


def _entities(spin: InsideSpin, world: RosWorld) -> Iterator[EntityState]:
    nodes = tuple(_nodes(spin, world))
    made = chain(world.entities, world.builtins)
    return (each for each in made if any(each.node is node for node in nodes))


def _runs_on(entity: EntityState) -> bool:
    """Whether its callback surely ends by itself."""
    if entity.effects is None:
        return entity.library is not None or entity.callback in (None, NONE)
    return not entity.effects.blocking and not entity.effects.locks


def _is_answered_outside(client: EntityState, world: RosWorld) -> bool:
    """Whether it is a client of a service or an action that nothing in the program offers."""
    kind, key = SERVER_KINDS.get(client.kind), client.key
    if kind is None or not isinstance(key, Const):
        return False
    servers = (each for each in world.entities if each.kind is kind)
    return not any(not isinstance(each.key, Const) or each.key == key for each in servers)
