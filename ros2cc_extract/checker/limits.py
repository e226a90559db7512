"""Limits of a search, its progress, and what it has used."""

from __future__ import annotations

import resource
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

_STATM = Path('/proc/self/statm')
_PAGE_BYTES = resource.getpagesize()
_MB = 1024 * 1024


@dataclass(frozen=True, kw_only=True)
class Limits:
    """When a search gives up; ``None`` is no limit. Memory is that of the whole process."""

    states: int | None = None
    memory_mb: float | None = None
    seconds: float | None = None


@dataclass(frozen=True, kw_only=True)
class Progress:
    """Where a search is."""

    states: int
    transitions: int
    seconds: float


def memory_mb() -> float:
    """Return the resident memory of this process."""
    try:
        return int(_STATM.read_text().split()[1]) * _PAGE_BYTES / _MB
    except OSError:
        return peak_mb()


def peak_mb() -> float:
    """Return the highest resident memory of this process so far."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


class Watch:
    """Looks at the clock and the memory now and then."""

    def __init__(self, limits: Limits, progress: Callable[[Progress], None] | None) -> None:
        self._limits = limits
        self._progress = progress
        self._start = time.monotonic()

    def seconds(self) -> float:
        """Return the time since the search began."""
        return time.monotonic() - self._start

    def broken(self, states: int, transitions: int) -> str | None:
        """Report progress; return the reason to give up, or None to go on."""
        seconds = self.seconds()
        if self._progress:
            self._progress(Progress(states=states, transitions=transitions, seconds=seconds))
        limits = self._limits
        if limits.seconds is not None and seconds > limits.seconds:
            return f'the limit of {limits.seconds:g} s was reached'
        if limits.memory_mb is not None and memory_mb() > limits.memory_mb:
            return f'the limit of {limits.memory_mb:g} MB was reached'
        if limits.states is not None and states >= limits.states:
            return f'the limit of {limits.states} states was reached'
        return None
