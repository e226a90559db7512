"""
Which threads stand still: they really wait, and a thread that waits for them waits forever.

Runs inside the user's process: the standard library only.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Collection

# On its way without coming to a point: it waits, or computes for long.
_STANDS_S, _LONGEST_S = 0.012, 0.2


class Way:
    """The way of a thread from one point of control to the next."""

    def __init__(self) -> None:
        self._since = time.monotonic()
        self._stood: object = None

    def stands(self, thread: int, now: float) -> bool:
        """Whether it has not moved since this was asked last, or is on its way for too long."""
        age = now - self._since
        if age < _STANDS_S:
            return False
        at = places([thread]).get(thread)
        stood, self._stood = self._stood, at
        return age > _LONGEST_S or (at is not None and at == stood)


class Rest:
    """Where several threads stand."""

    def __init__(self) -> None:
        self._stood: dict[int, tuple[int, int]] = {}

    def is_the_same(self, threads: Collection[int]) -> bool:
        """Whether these are the threads that stood there when this was asked last."""
        before, self._stood = self._stood, places(threads)
        return before == self._stood


def places(threads: Collection[int]) -> dict[int, tuple[int, int]]:
    """The innermost frame of each thread that is there, and its instruction."""
    frames = sys._current_frames()
    found = ((each, frames[each]) for each in threads if each in frames)
    return {each: (id(frame), frame.f_lasti) for each, frame in found}
