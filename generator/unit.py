"""A closed specification as the templates see it: names, numbers and types, nothing else."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

from ros2cc_extract.generator.serving import ExecutorKind, executor_kind, rank_of
from ros2cc_extract.generator.waits import server_of, waits_of
from ros2cc_extract.spec.close import ClosedSpec


@dataclass(frozen=True)
class UnitWait:
    """A wait for the callback at ``place``; an ``await`` frees the thread."""

    place: int
    frees_thread: bool


@dataclass(frozen=True, kw_only=True)
class UnitCallback:
    """
    A callback of the model.

    :param index: its place in the model's tables, from 0.
    :param group: place of its group.
    :param node: place of its node.
    :param rank: when it is served among what is ready, 0 first.
    :param waits: what it waits for while it runs, in order.
    :param server: place of the service that answers a client of the unit.
    """

    index: int
    name: str
    type: str
    group: int
    node: int
    rank: int
    waits: tuple[UnitWait, ...]
    server: int | None

    @property
    def needs(self) -> tuple[int, ...]:
        """Places of the callbacks it waits for."""
        return tuple(wait.place for wait in self.waits)


@dataclass(frozen=True, kw_only=True)
class UnitGroup:
    """A callback group of the model; ``index`` is its place in the model's tables."""

    index: int
    name: str
    type: str


@dataclass(frozen=True, kw_only=True)
class Unit:
    """
    What a model is made of.

    :param max_cycle: how often each callback may become ready; ``None`` for no bound.
    """

    name: str
    kind: ExecutorKind
    num_nodes: int
    callbacks: tuple[UnitCallback, ...]
    groups: tuple[UnitGroup, ...]
    threads: tuple[str, ...]
    executor: str
    max_cycle: int | None

    @property
    def num_waits(self) -> int:
        """The largest number of waits in one callback."""
        return max(len(callback.needs) for callback in self.callbacks)

    @property
    def has_awaits(self) -> bool:
        """True when a callback suspends itself."""
        return any(wait.frees_thread for callback in self.callbacks for wait in callback.waits)

    @property
    def called(self) -> frozenset[int]:
        """Places of the clients whose answers a callback waits for: nothing else arrives there."""
        needed = {place for callback in self.callbacks for place in callback.needs}
        return frozenset(place for place in needed if self.callbacks[place].type == 'CLT')

    @property
    def related(self) -> frozenset[int]:
        """Places of the callbacks that wait for another one or are waited for."""
        waiting = {callback.index for callback in self.callbacks if callback.needs}
        return frozenset(waiting.union(*(callback.needs for callback in self.callbacks)))

    def flags(self, places: Collection[int]) -> str:
        """Write a truth value for each callback: whether its place is among ``places``."""
        return ', '.join(str(c.index in places).lower() for c in self.callbacks)

    @property
    def queue_depth(self) -> int:
        """
        How much can wait for one callback.

        That is what arrives by itself, and one request or answer for each callback that can wait
        at the same time: on a thread, or suspended.
        """
        by_itself = self.max_cycle or 1
        if not self.num_waits:
            return by_itself
        return by_itself + len(self.threads) + len(self.callbacks)

    @property
    def servers(self) -> tuple[str, ...]:
        """The instances that serve callbacks, in system order: executor, threads, groups."""
        return (self.executor, *self.threads, *(group.name for group in self.groups))

    @property
    def processes(self) -> tuple[str, ...]:
        """All instances in system order: executor, threads, groups, callbacks."""
        return (*self.servers, *(callback.name for callback in self.callbacks))

    def group_of(self, callback: UnitCallback) -> UnitGroup:
        """The group of a callback of this unit."""
        return self.groups[callback.group]


def number_unit(closed: ClosedSpec, max_cycle: int | None) -> Unit:
    """Give every callback and group of ``closed`` its place, in the order of the spec."""
    spec = closed.spec
    places = {callback.name: index for index, callback in enumerate(spec.callbacks)}
    groups = {group.name: index for index, group in enumerate(spec.groups)}
    nodes = {callback.node: 0 for callback in spec.callbacks}
    nodes = {node: index for index, node in enumerate(nodes)}
    return Unit(
        name=spec.name,
        kind=executor_kind(spec),
        num_nodes=len(nodes),
        callbacks=tuple(
            UnitCallback(
                index=index,
                name=callback.name,
                type=callback.type.value,
                group=groups[callback.group],
                node=nodes[callback.node],
                rank=rank_of(callback),
                waits=tuple(
                    UnitWait(places[wait.needed], wait.frees_thread)
                    for wait in waits_of(callback, spec)
                ),
                server=places.get(server_of(callback, spec) or ''),
            )
            for index, callback in enumerate(spec.callbacks)
        ),
        groups=tuple(
            UnitGroup(index=index, name=group.name, type=group.type.value)
            for index, group in enumerate(spec.groups)
        ),
        threads=spec.executor.threads,
        executor=spec.executor.name,
        max_cycle=max_cycle,
    )
