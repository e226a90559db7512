"""Limits of a search, its progress, and what it has used."""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from ros2cc_extract.deadline import Deadline
from ros2cc_extract.light_dataclasses import dataclass

try:
    import resource
except ImportError:  # a Python without processes of its own, as in a browser
    resource = None  # type: ignore[assignment]

_MEMINFO = Path('/proc/meminfo')
_STATM = Path('/proc/self/statm')
_PAGE_BYTES = os.sysconf('SC_PAGE_SIZE')
_MB = 1024 * 1024
#: What a search may take between two looks.
_STEP_MB = 4
#: Part of the memory that the exploration may take when lassos are looked for later.
WITH_LASSOS = 0.8


@dataclass(frozen=True, kw_only=True)
class Limits:
    """
    When a search gives up; ``None`` is no limit. Memory is that of the whole process.

    :param seconds: of one search; ``deadline`` is for this one and others.
    """

    states: int | None = None
    memory_mb: float | None = None
    seconds: float | None = None
    deadline: Deadline | None = None

    def begun(self) -> Limits:
        """The same from now on, for all searches that share these seconds."""
        if self.seconds is None:
            return self
        own = Deadline(time.monotonic() + self.seconds, seconds_reason(self.seconds))
        earliest = min(filter(None, (own, self.deadline)), key=lambda deadline: deadline.at)
        return replace(self, seconds=None, deadline=earliest)

    @property
    def seconds_left(self) -> float | None:
        """What a program that knows seconds alone may take."""
        if self.deadline is None:
            return self.seconds
        left = max(0.0, self.deadline.at - time.monotonic())
        return left if self.seconds is None else min(left, self.seconds)

    @property
    def is_over(self) -> bool:
        """Whether the deadline has passed."""
        return self.deadline is not None and self.deadline.is_over


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
    """Return the highest resident memory of this process so far; 0 if it is not counted."""
    if resource is None:
        return 0.0
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def most_of_the_memory_mb() -> float | None:
    """Return what this process may take if it leaves a tenth of the free memory to others."""
    try:
        lines = _MEMINFO.read_text().splitlines()
    except OSError:
        return None
    free_kb = [int(line.split()[1]) for line in lines if line.startswith('MemAvailable:')]
    return memory_mb() + 0.9 * free_kb[0] / 1024 if free_kb else None


def is_memory_known() -> bool:
    """Whether this process can learn how much memory it has taken."""
    return resource is not None or _STATM.exists()


def states_reason(limit: int | None) -> str:
    """Return the reason to give up when a state more than the limit was found."""
    return f'the limit of {limit} states was reached'


def seconds_reason(limit: float) -> str:
    """Return the reason to give up when the time of a search, or of a model, is over."""
    return f'the limit of {limit:g} s was reached'


class Watch:
    """
    Looks at the clock and the memory now and then; states are for the searches to count.

    Without a limit on memory, most of what the machine has free is the limit: the system would
    end the process otherwise, and with it what is known.

    :param share: part of the memory for the exploration; the search for lassos gets the rest.
    """

    def __init__(
        self,
        limits: Limits,
        progress: Callable[[Progress], None] | None,
        share: float = 1.0,
    ) -> None:
        self._share = share
        self._limits = limits
        self._memory_mb = limits.memory_mb or most_of_the_memory_mb()
        self._progress = progress
        self._start = time.monotonic()

    def seconds(self) -> float:
        """Return the time since the search began."""
        return time.monotonic() - self._start

    def exhausted(self) -> str | None:
        """Return the reason to give up if the time is over, or all of the memory is used."""
        limit = self._limits.seconds
        if limit is not None and self.seconds() > limit:
            return seconds_reason(limit)
        deadline = self._limits.deadline
        if deadline is not None and deadline.is_over:
            return deadline.reason
        return self._out_of_memory(0, 1.0)

    def _out_of_memory(self, more_bytes: int, share: float) -> str | None:
        limit = self._memory_mb
        if limit is not None and not is_memory_known():
            return 'there is a limit on memory, but memory cannot be measured here'
        if limit is None or memory_mb() + more_bytes / _MB + _STEP_MB <= share * limit:
            return None
        return f'the limit of {limit:.0f} MB was reached'

    def broken(self, states: int, transitions: int, more_bytes: int = 0) -> str | None:
        """
        Report progress; return the reason to give up, or None to go on.

        :param more_bytes: what is about to be allocated.
        """
        seconds = self.seconds()
        if self._progress:
            self._progress(Progress(states=states, transitions=transitions, seconds=seconds))
        return self.exhausted() or self._out_of_memory(more_bytes, self._share)
