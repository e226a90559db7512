"""Repeats the schedule of a failure."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence

from ros2cc_extract.explore.exploring import PLAIN_S
from ros2cc_extract.explore.failures import Failure
from ros2cc_extract.explore.scenario import PLAIN, Found, Row
from ros2cc_extract.explore.watching import Process
from ros2cc_extract.light_dataclasses import dataclass

PROCESSES, TAILS = 3, 5
"""So many processes are tried, and in each so often what leads to the failure directly."""
_SECONDS = 8.0


@dataclass(frozen=True)
class Replay:
    """
    :param failure: as it was seen again, `None` where it was not.
    :param tries: schedules that were run for it.
    """

    failure: Failure | None
    processes: int
    tries: int
    seconds: float


def schedules_of(found: Found, process: int = 1) -> list[Row]:
    """
    What is tried in one process, the first or a later one.

    What led to the failure directly comes again and again, as where the program stood before may
    differ. All of its schedule comes after that, in every other process before: what a program
    does at first it does but once.
    """
    if found.schedule['policy'] == PLAIN or not found.choices:
        return [{'number': 1, 'policy': PLAIN, 'seconds': PLAIN_S}]
    tail = {'policy': 'recorded', 'choices': found.tail, 'seconds': _SECONDS, 'gather_s': 0.0}
    whole = {**tail, 'choices': found.choices, 'seconds': 2 * _SECONDS}
    rows = [*[tail] * TAILS, whole] if process % 2 else [whole, *[tail] * TAILS]
    return [{**row, 'number': number} for number, row in enumerate(rows, 1)]


Run = Callable[[Sequence[Row], Callable[[Failure], bool]], Process]


def replay(found: Found, run: Run) -> Replay:
    """
    Try until the failure is seen again.

    :raises KeyboardInterrupt: if the user has pressed Ctrl-C.
    """
    begun, tries = time.monotonic(), 0
    for number in range(1, PROCESSES + 1):
        process = run(schedules_of(found, number), found.failure.is_like)
        for seen in process.schedules:
            tries += 1
            for failure in seen.failures:
                if failure.is_like(found.failure):
                    return Replay(failure, number, tries, time.monotonic() - begun)
        if process.interrupted:
            raise KeyboardInterrupt
    return Replay(None, PROCESSES, tries, time.monotonic() - begun)
