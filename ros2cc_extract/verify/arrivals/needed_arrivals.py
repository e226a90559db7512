"""Claims that one arrival for each callback would leave empty, or hold by that alone."""

from __future__ import annotations

from collections.abc import Mapping

from ros2cc_extract.generator.build import Family, Profile, Query
from ros2cc_extract.generator.executor_kinds import ExecutorKind, executor_kind
from ros2cc_extract.generator.waits import waits_of
from ros2cc_extract.spec.model import Callback, GroupType, Spec
from ros2cc_extract.spec.self_exclusion import admits_one, is_made_once, lets_one_wait

TWO_ARRIVALS = 2


def needs_two_arrivals(query: Query, spec: Spec, profile: Profile) -> bool:
    """
    Return whether a callback may overlap itself as far as groups and threads go.

    With one arrival it runs once, and nothing could refute that it never does. A member of a
    mutually exclusive group, and a callback on an only thread, never overlaps itself.
    """
    if profile is not Profile.RCLPY or query.family is not Family.SELF_OVERLAP:
        return False
    if executor_kind(spec) is not ExecutorKind.MULTI_THREADED or len(spec.executor.threads) < 2:
        return False
    callback = next(c for c in spec.callbacks if c.name == query.callbacks[0])
    return spec.group_of(callback).type is GroupType.REENTRANT


def crowding(spec: Spec) -> Mapping[str, int]:
    """
    The callbacks that may fill all threads with their own runs, and how many runs that takes.

    A callback of a reentrant group holds a thread in each run that waits. One that keeps a lock
    over an ``await`` holds none there, but each further run holds the thread on which it waits
    for that lock: so many as there are threads, and one that keeps it.
    """
    has_pool = executor_kind(spec) is ExecutorKind.MULTI_THREADED
    threads = len(spec.executor.threads) if has_pool else 1
    runs = ((c.name, _runs_to_fill(threads, c, spec)) for c in spec.callbacks)
    return {name: number for name, number in runs if number > 1}


def _runs_to_fill(threads: int, callback: Callback, spec: Spec) -> int:
    if spec.group_of(callback).type is not GroupType.REENTRANT:
        return 1
    if callback.one_shot or is_made_once(callback):
        return 1
    if lets_one_wait(callback) or admits_one(callback, spec):
        return 1
    waits = [wait for wait in waits_of(callback, spec) if not wait.is_signal]
    if any(wait.frees_thread and wait.held for wait in waits):
        return threads + 1
    return threads if any(not wait.frees_thread for wait in waits) else 1
