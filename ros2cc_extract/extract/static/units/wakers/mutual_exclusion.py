"""Callbacks that cannot run at the same time: an answer of one is not changed by another."""

from __future__ import annotations

from collections.abc import Collection

from ros2cc_extract.extract.static.concurrency.machine.state import ActivityState
from ros2cc_extract.extract.static.libraries.rclpy.machine.end_operations import executor_of
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import (
    LOOP_KIND,
    EntityState,
    ExecutorState,
    GroupState,
)
from ros2cc_extract.extract.static.python.machine.recorded_effects import EffectLog
from ros2cc_extract.spec.effects import Blocking
from ros2cc_extract.spec.model import GroupType

_ONE_THREAD = ('SingleThreadedExecutor', LOOP_KIND)


def keeps_to_itself(doer: object, others: Collection[object]) -> bool:
    """
    Whether none of ``others`` runs between what a callback asks and what it does then.

    All are callbacks of one executor with one thread, or members of one exclusive group; and the
    callback itself never lets others run, as an ``await`` and a nested spin do.
    """
    everybody = [each for each in (doer, *others) if isinstance(each, EntityState)]
    if len(everybody) != 1 + len(others) or _lets_others_run(everybody[0]):
        return False
    executors = [executor_of(each.node) for each in everybody]
    first = executors[0]
    if first is None or any(each is not first for each in executors):
        return False
    return _has_one_thread(first.state) or _is_one_group(everybody)


def may_not_overlap(one: object, other: object) -> bool:
    """Whether the one waits for its turn while the other has a thread."""
    everybody = [each for each in (one, other) if isinstance(each, EntityState)]
    executors = [executor_of(each.node) for each in everybody]
    if len(executors) != 2 or executors[0] is None or executors[0] is not executors[1]:
        return False
    return _has_one_thread(executors[0].state) or _is_one_group(everybody)


def keeps_out(doer: object, other: object, block: Blocking) -> bool:
    """
    Whether ``other`` does not run as long as ``doer`` is in that wait; it may be ``doer`` itself.

    An ``await`` and a nested spin give the thread to others, and keep the group.
    """
    if isinstance(doer, ActivityState):
        return other is doer and doer.count == 1
    if not isinstance(doer, EntityState) or not isinstance(other, EntityState):
        return False
    executor = executor_of(doer.node)
    if executor is None or executor is not executor_of(other.node):
        return False
    is_thread_taken = _has_one_thread(executor.state) and not _gives_thread(block)
    return is_thread_taken or _is_one_group((doer, other))


def _lets_others_run(doer: EntityState) -> bool:
    return any(map(_gives_thread, (doer.effects or EffectLog()).blocking))


def _gives_thread(block: Blocking) -> bool:
    return block.suspends or 'spin' in block.call


def _has_one_thread(state: object) -> bool:
    if not isinstance(state, ExecutorState) or state.unresolved is not None:
        return False
    return state.kind in _ONE_THREAD


def _is_one_group(everybody: Collection[EntityState]) -> bool:
    groups = [each.group for each in everybody]
    state = groups[0].state
    if not isinstance(state, GroupState) or state.unresolved is not None:
        return False
    return state.type is GroupType.EXCLUSIVE and all(each is groups[0] for each in groups)
