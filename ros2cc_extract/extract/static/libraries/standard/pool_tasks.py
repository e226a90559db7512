"""
Tasks of a pool that wait for tasks of the same pool: so many of them at once leave no thread.

A pool of one thread is in the model, its tasks take turns; how many tasks of a larger one run at
a time is not (CPython 3.12, ``concurrent/futures/thread.py``: a task that finds no idle thread,
where there are ``max_workers`` already, stays in the queue).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from ros2cc_extract.extract.static.concurrency.machine.state import ActivityState
from ros2cc_extract.extract.static.concurrency.machine.wake_operations import ResourceRef, Waking
from ros2cc_extract.extract.static.python.machine.recorded_effects import EffectLog
from ros2cc_extract.extract.static.python.values.values import Const, Instance
from ros2cc_extract.source_locations import Unknown

WORKERS = '__workers__'
"""Slot of a pool for the number of its threads."""


def why_no_thread(
    mine: Sequence[Waking], doer: object, name: Callable[[object], str | None]
) -> Unknown | None:
    """Why the code that would end a wait of a task may get no thread of the pool."""
    if not isinstance(doer, ActivityState) or doer.pool is None or doer.turns is not None:
        return None
    others = [waking.by for waking in mine if waking.by is not doer]
    if not others or not all(_is_of(other, doer.pool) for other in others):
        return None
    if not _may_fill(doer, doer.pool):
        return None
    who, by = name(doer) or 'the task', name(others[0]) or 'another task'
    return Unknown(
        f'as many runs of {who} at once as the pool has threads leave none for {by}', doer.place
    )


def _is_of(other: object, pool: Instance) -> bool:
    return isinstance(other, ActivityState) and other.pool is pool


def _may_fill(task: ActivityState, pool: Instance) -> bool:
    """Whether so many runs of it may be begun before one has ended."""
    if all(_waits_for(start.by, task) for start in task.starts):
        return False
    if isinstance(task.count, Unknown):
        return True
    workers = pool.slots.get(WORKERS)
    number = workers.value if isinstance(workers, Const) else None
    return isinstance(number, int) and task.count >= number


def _waits_for(starter: object, task: ActivityState) -> bool:
    """Whether the code that starts it goes on only when it has ended."""
    runners = {id(runner) for runner in task.runners}
    effects = getattr(starter, 'effects', None) or EffectLog()
    return any(
        isinstance(block.resource, ResourceRef)
        and block.resource.number in runners
        and block.seconds is None
        for block in effects.blocking
    )
