"""
Counts, periods and durations of one callback, in bounded memory.

Runs inside the user's process: the standard library only, nothing else of ours.
"""

from __future__ import annotations

import sys
from collections import deque
from collections.abc import Sequence
from typing import Any

# Enough for a median within a few per cent; extremes and counts are exact.
SAMPLES = 256


class Distribution:
    """Exact count, minimum and maximum; median and p99 of the last ``SAMPLES`` values."""

    __slots__ = ('count', 'largest', 'last', 'smallest')

    def __init__(self) -> None:
        self.count = 0
        self.smallest = sys.maxsize
        self.largest = 0
        self.last: deque[int] = deque(maxlen=SAMPLES)

    def add(self, value: int) -> None:
        if value < self.smallest:
            self.smallest = value
        if value > self.largest:
            self.largest = value
        self.count += 1
        self.last.append(value)

    def take_over(self, later: Distribution) -> None:
        """Go on with the values of another."""
        self.smallest = min(self.smallest, later.smallest)
        self.largest = max(self.largest, later.largest)
        self.count += later.count
        self.last.extend(later.last)

    def describe(self) -> dict[str, float] | None:
        """Seconds; ``None`` before the first value."""
        if not self.count:
            return None
        ordered = sorted(self.last)
        return {
            'min_s': _seconds(self.smallest),
            'median_s': _seconds(_quantile(ordered, 0.5)),
            'p99_s': _seconds(_quantile(ordered, 0.99)),
            'max_s': _seconds(self.largest),
        }


class Timings:
    """What was measured of one entity; fed with begins and ends in the order they happened."""

    __slots__ = ('_begun', '_last_begin', 'durations', 'periods', 'refused', 'runs', 'threads')

    def __init__(self) -> None:
        self.runs = 0
        self.refused = 0
        self.periods = Distribution()
        self.durations = Distribution()
        self.threads: set[int] = set()
        self._begun: list[tuple[int, int]] = []
        self._last_begin = 0

    def begin(self, clock_ns: int, thread: int) -> None:
        if self.runs:
            self.periods.add(clock_ns - self._last_begin)
        self.runs += 1
        self._last_begin = clock_ns
        self.threads.add(thread)
        self._begun.append((clock_ns, thread))

    @property
    def begun(self) -> list[tuple[int, int]]:
        """When the runs began that have not ended, the first one first, and in which thread."""
        return list(self._begun)

    def end(self, clock_ns: int, thread: int) -> None:
        """Close the last run begun by this thread; a coroutine may end in another one."""
        begun = self._begun
        if not begun:
            return
        index = len(begun) - 1
        while index and begun[index][1] != thread:
            index -= 1
        self.durations.add(clock_ns - begun.pop(index)[0])

    def take_over(self, later: Timings) -> None:
        """Go on as what was made again; the time between the two is no period."""
        self.runs += later.runs
        self.refused += later.refused
        self.periods.take_over(later.periods)
        self.durations.take_over(later.durations)
        self.threads |= later.threads
        self._begun += later._begun
        self._last_begin = later._last_begin or self._last_begin

    def describe(self) -> dict[str, Any]:
        return {
            'count': self.runs,
            'refused': self.refused,
            'running': len(self._begun),
            'threads': len(self.threads),
            'period': self.periods.describe(),
            'duration': self.durations.describe(),
        }


def _seconds(nanoseconds: int) -> float:
    """Give microseconds, beyond which nothing here is exact."""
    return round(nanoseconds / 1e9, 6)


def _quantile(ordered: Sequence[int], share: float) -> int:
    return ordered[min(len(ordered) - 1, int(share * len(ordered)))]
