"""A closed specification as the templates see it: names, numbers and types, nothing else."""

from __future__ import annotations

from dataclasses import dataclass

from ros2cc_extract.spec.close import ClosedSpec


@dataclass(frozen=True, kw_only=True)
class UnitCallback:
    """
    A callback of the model.

    :param index: its place in the model's tables, from 0.
    :param group: place of its group.
    """

    index: int
    name: str
    type: str
    group: int


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

    :param max_cycle: how often each callback may become ready.
    """

    name: str
    callbacks: tuple[UnitCallback, ...]
    groups: tuple[UnitGroup, ...]
    threads: tuple[str, ...]
    executor: str
    max_cycle: int

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


def number_unit(closed: ClosedSpec, max_cycle: int) -> Unit:
    """Give every callback and group of ``closed`` its place, in the order of the spec."""
    spec = closed.spec
    places = {group.name: index for index, group in enumerate(spec.groups)}
    return Unit(
        name=spec.name,
        callbacks=tuple(
            UnitCallback(
                index=index,
                name=callback.name,
                type=callback.type.value,
                group=places[callback.group],
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
