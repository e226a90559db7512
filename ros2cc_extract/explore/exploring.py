"""Explores a program: schedule after schedule, until the budget is used up."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import field, replace
from enum import Enum

from ros2cc_extract.explore.failures import Kind
from ros2cc_extract.explore.scenario import PLAIN, Found, Row
from ros2cc_extract.explore.watching import Process, Seen
from ros2cc_extract.light_dataclasses import dataclass

A_PROCESS = 20
"""
So many schedules run in one process, one after the other, as long as none of them hangs. The next
processes run a single one each, as what a program does at first it does but once.
"""
# Of so many processes one runs many schedules: the one after the plain run is the first.
_CYCLE = 4
PLAIN_S = 3.0
FIRST_GATHER_S = 1.0
"""What happens but once is to meet as much as can be, so all that may be ready is waited for."""
# The same hang so often in a row: nothing else is reached any more.
_MOST_ALIKE = 3
_FIRST_STEPS = 12


class Strategy(Enum):
    """How schedules are chosen."""

    MIXED = 'mixed'
    PCT = 'pct'
    RANDOM = 'random'
    PREEMPTIONS = 'preemptions'


@dataclass(frozen=True, kw_only=True)
class Budget:
    """
    :param schedules: at most so many, besides the plain one.
    :param deadline: of the clock `time.monotonic`.
    :param a_process: so many in one process.
    :param only_first: end with the first failure.
    """

    schedules: int
    deadline: float = float('inf')
    a_process: int = A_PROCESS
    only_first: bool = False


@dataclass
class Exploration:
    """
    What was found so far.

    :param done: schedules that were run, without the plain one.
    :param processes: how often the program was started.
    :param why_ended: as the end of a sentence.
    :param statement: what all of it says together, where it says more than each.
    """

    found: list[Found] = field(default_factory=list)
    done: int = 0
    processes: int = 0
    begins: int = 0
    why_ended: str = ''
    statement: str = ''
    last_words: str = ''


def schedule_row(strategy: Strategy, seed: int, number: int, steps: int) -> dict[str, object]:
    """
    Give a schedule.

    Of the mixed strategy random priorities and a random walk take turns; of random priorities and
    few preemptions the depths 2, 3 and 4 do.

    :param steps: among so many it is chosen where a thread falls, or another one goes on.
    """
    depth = 2 + number // 2 % 3
    if strategy is Strategy.MIXED:
        strategy = Strategy.PCT if number % 2 else Strategy.RANDOM
    return {
        'number': number,
        'policy': strategy.value,
        'seed': f'{seed}/{number}',
        'depth': depth,
        'steps': steps,
    }


Run = Callable[[Sequence[Row]], Process]
Progress = Callable[[Exploration], None]


def plain(run: Run) -> Process:
    """Run the program once as it comes, for a few seconds."""
    return run([{'number': 0, 'policy': PLAIN, 'seconds': PLAIN_S}])


def explore(
    run: Run,
    strategy: Strategy,
    seed: int,
    budget: Budget,
    into: Exploration,
    progress: Progress = lambda so_far: None,
) -> None:
    """
    Run schedules until the budget is used up, or nothing new can be reached.

    :param run: runs schedules in one process.
    :param into: is filled as it goes, so that what was found is known whenever this ends.
    """
    alike, steps = 0, _FIRST_STEPS
    while not into.why_ended:
        a_process = budget.a_process if into.processes % _CYCLE == 1 else 1
        count = min(a_process, budget.schedules - into.done)
        if count <= 0:
            into.why_ended = 'all schedules were run'
        elif time.monotonic() > budget.deadline:
            into.why_ended = 'the time is over'
        else:
            first = into.done + 1
            rows = [schedule_row(strategy, seed, first + each, steps) for each in range(count)]
            if a_process == 1:
                rows = [{**row, 'gather_s': FIRST_GATHER_S} for row in rows]
            process = run(rows)
            news = note(process, into)
            lengths = [len(each.choices) for each in process.schedules if each.choices]
            steps = round(statistics.mean(lengths)) if lengths else steps
            progress(into)
            alike = 0 if news or not _hangs(process) else alike + 1
            into.why_ended = _why(process, into, budget, alike)


def _why(process: Process, into: Exploration, budget: Budget, alike: int) -> str:
    if into.found and budget.only_first:
        return 'a failure was found'
    if not process.schedules:
        return 'the program did not get to a schedule'
    if alike >= _MOST_ALIKE:
        return 'every process hangs at the same place: mend that first'
    return ''


def _hangs(process: Process) -> bool:
    return any(
        failure.kind in (Kind.HANG, Kind.STANDS)
        for each in process.schedules
        for failure in each.failures
    )


def note(process: Process, into: Exploration) -> bool:
    """
    Add what a process has shown; whether any of it is new.

    :raises KeyboardInterrupt: after that, where the process was interrupted.
    """
    news = False
    into.processes += 1
    into.last_words = process.said
    for seen in process.schedules:
        into.done += seen.row['policy'] != PLAIN
        into.begins += seen.begins
        for found in founds_of(seen):
            known = next(
                (each for each in into.found if each.failure.is_like(found.failure)), None
            )
            if known is None:
                into.found.append(found)
                news = True
            else:
                into.found[into.found.index(known)] = replace(known, times=known.times + 1)
    if process.interrupted:
        raise KeyboardInterrupt
    return news


def founds_of(seen: Seen) -> Iterator[Found]:
    """Its failures, each with the choices that lead there."""
    for failure in seen.failures:
        end = failure.step or len(seen.choices)
        choices = tuple(seen.choices[:end])
        yield Found(
            failure=failure,
            schedule=seen.row,
            number=int(seen.row['number']),
            tail=choices[_begin_of_tail(seen, end, failure.kind) :],
            choices=choices,
        )


def _begin_of_tail(seen: Seen, end: int, kind: Kind) -> int:
    """The last moment before at which no thread was at work."""
    quiet = [0, *(each for each in seen.rounds if 0 < each < end)]
    # An exception is reported when its callback is over, and another may have begun since.
    return quiet[-2] if kind is Kind.EXCEPTION and len(quiet) > 1 else quiet[-1]
