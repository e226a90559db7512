"""
Whether two callbacks may run at the same time: by the model's verdict, else by the groups.

Nothing is claimed of callbacks whose group or executor could not be followed.
"""

from __future__ import annotations

from ros2cc_extract.findings.base.rule import Context
from ros2cc_extract.findings.waits.capacity import can_overlap_itself
from ros2cc_extract.findings.waits.verdicts import CAN_OVERLAP, verdict_on
from ros2cc_extract.findings.waits.waits import WaitKind, kind_of
from ros2cc_extract.findings.waits.workers import honours_groups, is_one_thread, runs_in_parallel
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.model import Callback, EntityKind, exclude_each_other
from ros2cc_extract.verify.results.evidence import Evidence
from ros2cc_extract.verify.results.rates import demand_of
from ros2cc_extract.verify.results.results import Verdict


@dataclass(frozen=True)
class Overlap:
    """
    Two callbacks may run at the same time.

    :param run: a run of the model that shows it.
    """

    run: Evidence | None = None


def overlap(one: Callback, other: Callback, context: Context) -> Overlap | None:
    """Say how ``one`` and ``other`` may overlap; ``None`` when they may not, or it is open."""
    if not _is_settled(one, other, context):
        return None
    result = verdict_on(CAN_OVERLAP, context, one, other)
    if result is not None and result.verdict is Verdict.SATISFIED:
        return Overlap(result.evidence)
    if result is not None and result.verdict is Verdict.NOT_SATISFIED:
        return None
    return Overlap() if _groups_allow(one, other, context) else None


def interleaves(callback: Callback, other: Callback, context: Context) -> bool:
    """
    True when ``other`` may run while ``callback`` awaits something on an executor with one thread.

    A coroutine gives its thread back at an ``await`` and keeps its group closed. Source: rclpy
    7.1.6 and 9.1.2, ``executors.py`` (``_make_handler``), ``task.py``; the events executor asks
    no group and is left out.
    """
    executor = context.unit.executor
    if not callback.coroutine or not is_one_thread(executor) or not honours_groups(executor):
        return False
    if any(context.group_of(each).unresolved is not None for each in (callback, other)):
        return False
    if callback.name == other.name:
        return can_overlap_itself(callback, context)
    return not exclude_each_other(callback, other) and _groups_allow(callback, other, context)


def overlaps_itself(callback: Callback, context: Context) -> bool:
    """
    True when two runs of one entity may coincide on this executor.

    A model in which everything arrives once says that nothing ever overlaps itself, so only its
    run that shows an overlap counts here, as evidence.
    """
    parallel = runs_in_parallel(context.unit.executor)
    return parallel and can_overlap_itself(callback, context)


def is_quick(callback: Callback, context: Context) -> bool:
    """
    True where a run is known to be shorter than the time from one to the next.

    A timer has its period, and a subscription that of the one timer which publishes for it: only
    messages that were held up come together. A done-callback has that of the timer which asks,
    where only its own runs do: then two answers come together only after one has
    been late by a period.
    """
    if not all(kind_of(block) is WaitKind.SLEEP for block in callback.blocking):
        return False
    if callback.entity is EntityKind.DONE_CALLBACK:
        asking = _asking_timer(callback, context)
        return asking is not None and _is_shorter(callback, asking.period_s)
    if callback.entity is EntityKind.TIMER and not callback.blocking:
        return True
    is_timed = callback.entity in (EntityKind.TIMER, EntityKind.SUBSCRIPTION)
    return is_timed and _is_shorter(callback, callback.period_s)


def _is_shorter(callback: Callback, period: float | Unknown | None) -> bool:
    is_known = all(isinstance(block.seconds, float) for block in callback.blocking)
    slept = demand_of(callback, ()).duration_s or 0.0
    return is_known and isinstance(period, float) and slept < period


def _asking_timer(callback: Callback, context: Context) -> Callback | None:
    """The only other one that adds the done-callback, if it is a timer whose runs are in turn."""
    made = EntityKind.DONE_CALLBACK.value, callback.source
    asks = [
        (each, act)
        for each in context.doers
        for act in each.changes
        if (act.name, act.source) == made
    ]
    others = [each for each, _ in asks if each.name != callback.name]
    if len(others) != 1 or callback.count != 1 or any(act.repeats for _, act in asks):
        return None
    one = others[0]
    if not isinstance(one, Callback) or one.entity is not EntityKind.TIMER:
        return None
    return one if context.exclusive_group(one) is not None else None


def _is_settled(one: Callback, other: Callback, context: Context) -> bool:
    open_groups = any(context.group_of(c).unresolved is not None for c in (one, other))
    branches = exclude_each_other(one, other)
    return not open_groups and not branches and runs_in_parallel(context.unit.executor)


def _groups_allow(one: Callback, other: Callback, context: Context) -> bool:
    group = context.exclusive_group(one)
    return group is None or one.group != other.group
