"""Which executor of rclpy serves a unit, and in which order it serves what is ready."""

from __future__ import annotations

from enum import Enum

from ros2cc_extract.spec.model import Callback, CallbackType, EntityKind, Spec
from ros2cc_extract.spec.releases.table import TASKS_OLDEST_FIRST


class ExecutorKind(Enum):
    """The executors of rclpy, by class name; a loop of asyncio by that of the nodes it runs."""

    SINGLE_THREADED = 'SingleThreadedExecutor'
    MULTI_THREADED = 'MultiThreadedExecutor'
    EVENTS = 'EventsExecutor'
    ASYNCIO = 'AsyncNode'

    @property
    def has_laps(self) -> bool:
        """Whether it waits, collects what is ready, and serves that before it waits again."""
        return self in (ExecutorKind.SINGLE_THREADED, ExecutorKind.MULTI_THREADED)


_OF_NAME = {kind.value: kind for kind in ExecutorKind}


def executor_kind(spec: Spec) -> ExecutorKind:
    """Name the executor; a class of the user's own counts as the one with as many threads."""
    kind = _OF_NAME.get(spec.executor.kind) if isinstance(spec.executor.kind, str) else None
    if kind is not None:
        return kind
    is_single = len(spec.executor.threads) == 1
    return ExecutorKind.SINGLE_THREADED if is_single else ExecutorKind.MULTI_THREADED


class TaskOrder(Enum):
    """Which of the tasks that wait is served first."""

    NEWEST_FIRST = 'newest'
    OLDEST_FIRST = 'oldest'


def task_order(rclpy: str | None) -> TaskOrder | None:
    """Return in which order a version of rclpy serves tasks; ``None`` if that is not known."""
    is_oldest_first = TASKS_OLDEST_FIRST.holds(rclpy)
    if is_oldest_first is None:
        return None
    return TaskOrder.OLDEST_FIRST if is_oldest_first else TaskOrder.NEWEST_FIRST


# Source: rclpy 7.1.6, executors.py, _wait_for_ready_callbacks: tasks, then the waitables of all
# nodes, then node by node timers, subscriptions, guard conditions, clients, services.
TASK_RANK, _WAITABLE, _TIMER, _SUBSCRIPTION, GUARD_RANK, _CLIENT, _SERVICE = range(7)

#: From this rank on nodes are served one after the other; tasks and waitables of all come first.
NODE_RANK = TIMER_RANK = _TIMER

#: A guard condition that is queued, and triggered, is queued once more, and so is what two
#: threads find at a time that spin one pool (rclpy 7.1.6, 9.1.2).
QUEUED_TWICE = 2

_RANK = {
    EntityKind.ACTION_EXECUTE: TASK_RANK,
    EntityKind.DONE_CALLBACK: TASK_RANK,
    EntityKind.TASK: TASK_RANK,
    EntityKind.ACTION_SERVER: _WAITABLE,
    EntityKind.ACTION_CLIENT: _WAITABLE,
    EntityKind.WAITABLE: _WAITABLE,
    EntityKind.QOS_EVENT: _WAITABLE,
    EntityKind.TIMER: _TIMER,
    EntityKind.SUBSCRIPTION: _SUBSCRIPTION,
    EntityKind.GUARD_CONDITION: GUARD_RANK,
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


def rank_of(callback: Callback) -> int:
    """Return the position of an entity among what is ready: 0 is served first."""
    if callback.entity is None:
        return _RANK_OF_TYPE[callback.type]
    return _RANK[callback.entity]


def runs_of_an_arrival(callback: Callback) -> int:
    """Return how many runs one arrival can give at one time while nothing spins."""
    return QUEUED_TWICE if rank_of(callback) == GUARD_RANK else 1
