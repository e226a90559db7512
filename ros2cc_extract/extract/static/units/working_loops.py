"""
Threads that work in a loop which nothing ends: ``while self.running:`` with a flag never cleared.

Such a loop is no wait: the thread works, as in ``while True:``. Only code that waits for what is
behind the loop waits for its end. For ``main``, which may join it when the spin is over, see
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
    """``activities``; without such a loop, but with ``loops``, unless others wait for its end."""
    actors: list[Callback | Activity] = [*callbacks, *activities]
    behind = list(_behind(block for each in actors for block in each.blocking))
    return tuple(_without_loop(each, behind) for each in activities)


def _behind(waits: Iterable[Blocking]) -> Iterator[tuple[str, int | None]]:
    """The actors that end waits of others, each with the number of its own waits before that."""
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
