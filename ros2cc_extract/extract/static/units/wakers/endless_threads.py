"""Threads in an endless loop that a callback or another thread waits for."""

from __future__ import annotations

from collections.abc import Iterable

from ros2cc_extract.extract.static.concurrency.machine.state import ActivityState
from ros2cc_extract.extract.static.concurrency.machine.wake_operations import Waking
from ros2cc_extract.extract.static.python.machine.path_facts import Word
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.model import ActivityKind


def never_comes(waking: Waking, waiting: object) -> bool:
    """Whether it is the end of a thread that never ends, whatever happens to rclpy."""
    thread = _endless(waking, waiting)
    return thread is not None and thread.endless is not None


def why_no_end(wakings: Iterable[Waking], waiting: object) -> Unknown | None:
    """Why a thread may not end while the program runs and others wait for its end."""
    threads = (_endless(waking, waiting) for waking in wakings)
    thread = next((each for each in threads if each is not None), None)
    if thread is None:
        return None
    return Unknown(
        'the loop of the thread ends only by an error or with the program', thread.place
    )


def _endless(waking: Waking, waiting: object) -> ActivityState | None:
    """
    The thread whose end it is, if that loops and others wait for it.

    ``main`` waits to keep the program running; ``threads_at_exit.py`` reports what never ends.
    """
    is_main = isinstance(waiting, ActivityState) and waiting.kind is ActivityKind.MAIN
    if is_main or waking.word is not Word.END or not isinstance(waking.by, ActivityState):
        return None
    return waking.by if waking.by.loops and waking.by is not waiting else None
