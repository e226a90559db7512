"""
Threads that work in a loop which nothing ends: ``while self.running:`` with a flag never cleared.

Such a loop is no wait: the thread works, as in ``while True:``. Only code that waits for what is
behind the loop waits for its end. Where it is not known what ends the loop, it may go on as long
as others wait for what its rounds give, or be over. For ``main``, which may join it when the spin
is over, see ``whole_program/joined_threads.py``.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from typing import TypeVar

from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.effects import POLLING_LOOP, WORKING_LOOP, Blocking
from ros2cc_extract.spec.model import Activity, Callback

_Actor = TypeVar('_Actor', Callback, Activity)


def without_loops_for_good(
    activities: Sequence[Activity], callbacks: Sequence[Callback]
) -> tuple[tuple[Activity, ...], tuple[Callback, ...]]:
    """
    The same; without such a loop, but with ``loops``, unless others wait for its end.

    Of what may be over, others have no certainty.
    """
    actors: list[Callback | Activity] = [*callbacks, *activities]
    behind = list(_behind(block for each in actors for block in each.blocking))
    found = tuple(_without_loop(each, behind) for each in activities)
    pairs = zip(activities, found, strict=True)
    open_now = {
        new.name for old, new in pairs if new.loops is not old.loops and new.loops is not True
    }
    if not open_now:
        return found, tuple(callbacks)
    return (
        tuple(_in_doubt(each, open_now) for each in found),
        tuple(_in_doubt(each, open_now) for each in callbacks),
    )


def _behind(waits: Iterable[Blocking]) -> Iterator[tuple[str, int | None]]:
    """The actors that end waits of others, each with the number of its own waits before that."""
    for block in waits:
        for waker in block.wakers:
            yield waker.by, waker.after


def _without_loop(activity: Activity, behind: Sequence[tuple[str, int | None]]) -> Activity:
    needed = [after for by, after in behind if by == activity.name]
    for number, block in enumerate(activity.blocking):
        loops: bool | Unknown = False
        if block.call == WORKING_LOOP and not (block.wakers or block.escapes or block.seconds):
            if any(after is None or after > number for after in needed):
                return activity
            loops = True
        elif _is_last(activity, number, needed):
            loops = _why_open(block) or False
        if loops:
            acts = (act for act in activity.publishes if act.after <= number)
            return replace(
                activity, blocking=activity.blocking[:number], publishes=tuple(acts), loops=loops
            )
    return activity


def _is_last(activity: Activity, number: int, needed: Sequence[int | None]) -> bool:
    """Whether nobody waits for what comes behind a wait, and somebody for what comes before."""
    gives = [after for after in needed if after is not None]
    return number == len(activity.blocking) - 1 and bool(gives) and max(gives) <= number


def _why_open(block: Blocking) -> Unknown | None:
    """Why it is not known when a loop ends."""
    if block.call not in (WORKING_LOOP, POLLING_LOOP):
        return None
    return block.escapes or (block.seconds if isinstance(block.seconds, Unknown) else None)


def _in_doubt(actor: _Actor, threads: Iterable[str]) -> _Actor:
    names = frozenset(threads)
    blocking = tuple(
        replace(
            block,
            wakers=tuple(
                replace(waker, conditional=waker.conditional or waker.by in names)
                for waker in block.wakers
            ),
        )
        for block in actor.blocking
    )
    return replace(actor, blocking=blocking)
