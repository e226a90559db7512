"""A closed specification as the templates see it: names, numbers and types, nothing else."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from ros2cc_extract.spec.close import ClosedSpec
from ros2cc_extract.spec.model import Callback, CallbackType, EntityKind, Spec


class ExecutorKind(Enum):
    """The executors of rclpy, by class name."""

    SINGLE_THREADED = 'SingleThreadedExecutor'
    MULTI_THREADED = 'MultiThreadedExecutor'
    EVENTS = 'EventsExecutor'


@dataclass(frozen=True, kw_only=True)
class UnitCallback:
    """
    A callback of the model.

    :param index: its place in the model's tables, from 0.
    :param group: place of its group.
    :param node: place of its node.
    :param rank: when it is served among what is ready, 0 first.
    """

    index: int
    name: str
    type: str
    group: int
    node: int
    rank: int


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
    groups = {group.name: index for index, group in enumerate(spec.groups)}
    nodes = {callback.node: 0 for callback in spec.callbacks}
    nodes = {node: index for index, node in enumerate(nodes)}
    return Unit(
        name=spec.name,
        kind=_executor_kind(spec),
        num_nodes=len(nodes),
        callbacks=tuple(
            UnitCallback(
                index=index,
                name=callback.name,
                type=callback.type.value,
                group=groups[callback.group],
                node=nodes[callback.node],
                rank=_rank(callback),
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


def _executor_kind(spec: Spec) -> ExecutorKind:
    """A class of the user's own counts as the class of rclpy with as many threads."""
    for kind in ExecutorKind:
        if spec.executor.kind == kind.value:
            return kind
    is_single = len(spec.executor.threads) == 1
    return ExecutorKind.SINGLE_THREADED if is_single else ExecutorKind.MULTI_THREADED


# Source: rclpy 7.1.6, executors.py, _wait_for_ready_callbacks: tasks, then the waitables of all
# nodes, then node by node timers, subscriptions, guard conditions, clients, services.
_TASK, _WAITABLE, _TIMER, _SUBSCRIPTION, _GUARD, _CLIENT, _SERVICE = range(7)

_RANK = {
    EntityKind.ACTION_EXECUTE: _TASK,
    EntityKind.DONE_CALLBACK: _TASK,
    EntityKind.TASK: _TASK,
    EntityKind.ACTION_SERVER: _WAITABLE,
    EntityKind.ACTION_CLIENT: _WAITABLE,
    EntityKind.WAITABLE: _WAITABLE,
    EntityKind.QOS_EVENT: _WAITABLE,
    EntityKind.TIMER: _TIMER,
    EntityKind.SUBSCRIPTION: _SUBSCRIPTION,
    EntityKind.GUARD_CONDITION: _GUARD,
    EntityKind.CLIENT: _CLIENT,
    EntityKind.SERVICE: _SERVICE,
    EntityKind.PARAMETER_SERVICE: _SERVICE,
    EntityKind.LIFECYCLE_SERVICE: _SERVICE,
}

_RANK_OF_TYPE = {
    CallbackType.TMR: _TIMER,
    CallbackType.SUB: _SUBSCRIPTION,
    CallbackType.CLT: _CLIENT,
    CallbackType.SRV: _SERVICE,
}


def _rank(callback: Callback) -> int:
    if callback.entity is None:
        return _RANK_OF_TYPE[callback.type]
    return _RANK[callback.entity]
