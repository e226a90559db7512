"""
Threads that work in a loop which nothing ends, as ``while self.running:`` where nobody clears it.

Such a loop is no wait: the thread works, as in ``while True:``. Only somebody who waits for what
comes behind the loop waits for its end. Of ``main``, which may join it when the spin is over, see
``whole_program/joined_threads.py``.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace

from ros2cc_extract.spec.effects import WORKING_LOOP, Blocking
from ros2cc_extract.spec.model import Activity, Callback


def without_loops_for_good(
    activities: Sequence[Activity], callbacks: Iterable[Callback]
) -> tuple[Activity, ...]:
    """``activities``, of which those that nobody waits for to get behind such a loop ``loops``."""
    actors: list[Callback | Activity] = [*callbacks, *activities]
    behind = list(_behind(block for each in actors for block in each.blocking))
    return tuple(_without_loop(each, behind) for each in activities)


def _behind(waits: Iterable[Blocking]) -> Iterator[tuple[str, int | None]]:
    """Who ends a wait of others, and behind how many waits of his own."""
    for block in waits:
        for waker in block.wakers:
            yield waker.by, waker.after


def _without_loop(activity: Activity, behind: Sequence[tuple[str, int | None]]) -> Activity:
    for number, block in enumerate(activity.blocking):
        if block.call == WORKING_LOOP and not (block.wakers or block.escapes or block.seconds):
            needed = [after for by, after in behind if by == activity.name]
            if any(after is None or after > number for after in needed):
                return activity
            acts = (act for act in activity.publishes if act.after <= number)
            return replace(
                activity, blocking=activity.blocking[:number], publishes=tuple(acts), loops=True
            )
    return activity
