"""Locks that are held over a long sleep, and the callbacks that wait for them meanwhile."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ros2cc_extract.findings.base.rule import Context, Doer
from ros2cc_extract.findings.waits.concurrent_threads import beside
from ros2cc_extract.findings.waits.overlap import overlap
from ros2cc_extract.findings.waits.waits import AnyWait, WaitKind, kind_of
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.spec.effects import FLAG, RE_ENTRANT, SHARED, Act
from ros2cc_extract.spec.model import Callback

LONG_ROUND_S = 0.1
"""From here on a sleep counts in a loop of unknown duration: our choice."""


@dataclass(frozen=True)
class LongHold:
    """
    A doer that sleeps, and keeps a lock.

    :param wait: the longest of the sleeps.
    :param seconds: how long they are in all; ``None`` if a loop goes on for an
        unknown time.
    :param takers: the callbacks that wait for the lock, each with where it takes it.
    """

    wait: AnyWait
    lock: str
    seconds: float | None
    takers: tuple[tuple[Callback, Act], ...]


def long_holds(context: Context, long_s: float) -> Iterator[LongHold]:
    """One for each lock that is held for ``long_s`` or for an unknown time."""
    for doer in context.doers:
        sleeps = [AnyWait(doer, b, kind_of(b)) for b in doer.blocking if b.held]
        sleeps = [wait for wait in sleeps if wait.kind is WaitKind.SLEEP]
        for lock in dict.fromkeys(lock for wait in sleeps for lock in wait.block.held):
            if not lock.endswith((SHARED, FLAG)):
                kept = [wait for wait in sleeps if lock in wait.block.held]
                yield from _of_lock(lock.removesuffix(RE_ENTRANT), kept, context, long_s)


def _of_lock(
    lock: str, sleeps: Sequence[AnyWait], context: Context, long_s: float
) -> Iterator[LongHold]:
    longest = max(sleeps, key=_seconds)
    takers = tuple(_takers(lock, longest.caller, context))
    endless = [wait for wait in sleeps if wait.block.repeats and _seconds(wait) >= LONG_ROUND_S]
    if takers and _seconds(longest) >= long_s:
        yield LongHold(longest, lock, _seconds(longest), takers)
    elif takers and endless:
        yield LongHold(max(endless, key=_seconds), lock, None, takers)


def _seconds(wait: AnyWait) -> float:
    seconds = wait.block.seconds
    return seconds * wait.block.times if isinstance(seconds, (int, float)) else 0.0


def _takers(lock: str, holder: Doer, context: Context) -> Iterator[tuple[Callback, Act]]:
    """Other callbacks that may run meanwhile; not another run of the holder."""
    for other in context.written:
        act = next((act for act in other.locks if act.name == lock and not act.tries), None)
        if act is not None and other.name != holder.name and _meet(holder, other, context):
            yield other, act


def _meet(holder: Doer, other: Callback, context: Context) -> bool:
    if isinstance(holder, Callback):
        return overlap(holder, other, context) is not None
    return beside(holder, other, context) is not None
