"""Runs schedules in one process of the program, and reads what comes of each."""

from __future__ import annotations

import functools
import os
import time
from collections.abc import Callable, Sequence
from dataclasses import field

from ros2cc_extract.confirm.observations import Row, Rows, Sample, sample_of
from ros2cc_extract.confirm.processes import Node, started_beside
from ros2cc_extract.explore.failures import (
    Failure,
    Kind,
    exception,
    hang,
    lost_update,
    stands,
)
from ros2cc_extract.explore.scenario import Scenario, plan_text
from ros2cc_extract.extract.live.exploring.exploration import VARIABLE
from ros2cc_extract.light_dataclasses import dataclass

# For an import of large packages, the discovery of DDS, and the offers of what is asked for.
START_S = 40.0
# Beyond its own seconds: letting go, and looking at what stands.
_MORE_S = 12.0
_READ_EVERY_S = 0.05
# After its last words the program may have ended by what was to be shown.
_AFTER_END_S = 0.3


@dataclass
class Seen:
    """
    What came of one schedule.

    :param choices: the chosen threads, and where each stood.
    :param choosable: the candidates.
    :param rounds: after how many choices no thread was at work.
    :param seconds: from its begin to its end.
    """

    row: Row
    failures: list[Failure] = field(default_factory=list)
    choices: list[tuple[str, str]] = field(default_factory=list)
    choosable: list[list[tuple[str, str]]] = field(default_factory=list)
    rounds: list[int] = field(default_factory=list)
    begins: int = 0
    samples: list[Sample] = field(default_factory=list)
    begun: float = 0.0
    seconds: float = 0.0
    is_done: bool = False


@dataclass
class Process:
    """
    What came of one process.

    :param schedules: those that were begun.
    :param ended: it ended before its schedules were over.
    :param interrupted: the user has pressed Ctrl-C; what was seen until then is here.
    :param files: in which the functions of callbacks stand; empty where that is not known.
    :param labels: names of the callbacks that have begun.
    """

    schedules: list[Seen] = field(default_factory=list)
    started: bool = False
    ended: bool = False
    interrupted: bool = False
    said: str = ''
    files: list[str] = field(default_factory=list)
    labels: list[str] = field(default_factory=list)


def run_process(
    scenario: Scenario,
    schedules: Sequence[Row],
    python: str,
    *,
    stubs: bool = False,
    deadline: float = float('inf'),
    until: Callable[[Failure], bool] = lambda failure: False,
) -> Process:
    """
    Start the program once, and run schedules in it until one of them hangs.

    :param deadline: of the clock `time.monotonic`; then the program is killed.
    :param until: whether a failure is the last that is asked for.
    :raises InputError, ToolNotFoundError: as ``started_beside``.
    """
    text = functools.partial(plan_text, scenario, schedules, os.getpid())
    with started_beside(
        scenario.command, {VARIABLE: text}, scenario.stimulus, python, stubs=stubs
    ) as node:
        return _Watch(schedules, until).watch(
            node, min(deadline, _give_up_at(scenario, schedules))
        )


def _give_up_at(scenario: Scenario, schedules: Sequence[Row]) -> float:
    seconds = sum(float(each.get('seconds', scenario.seconds)) for each in schedules)
    return time.monotonic() + START_S + seconds + _MORE_S * len(schedules)


class _Watch:
    def __init__(self, schedules: Sequence[Row], until: Callable[[Failure], bool]) -> None:
        self._until = until
        self._known = {int(each['number']): each for each in schedules}
        self._rows = Rows()
        self._pid = 0
        self._is_over = False
        self._found = Process()

    def watch(self, node: Node, deadline: float) -> Process:
        try:
            self._watch(node, deadline)
        except KeyboardInterrupt:
            self._found.interrupted = True
        self._found.said = node.said
        return self._found

    def _watch(self, node: Node, deadline: float) -> None:
        found, begun = self._found, time.monotonic()
        while not self._is_over and time.monotonic() < deadline:
            ended = node.process.poll() is not None
            if ended:
                time.sleep(_AFTER_END_S)
            for row in self._rows.read(node.report):
                try:
                    self._note(row)
                except (ValueError, KeyError, TypeError, AttributeError, IndexError):
                    continue  # another process has written there
            if not found.started and time.monotonic() - begun > START_S:
                break
            if ended:
                found.ended = not self._is_over
                break
            time.sleep(_READ_EVERY_S)

    def _note(self, row: Row) -> None:
        what, found = row['what'], self._found
        if what == 'started':
            self._pid, found.started = int(row['process']), True
        elif what == 'callback':
            found.labels.append(str(row['label']))
            found.files.append(str(row['file']))
        elif what == 'finished':
            self._is_over = True
        elif what == 'schedule':
            found.schedules.append(Seen(self._known[int(row['schedule'])], begun=row['at']))
        elif found.schedules:
            self._note_of_schedule(row, found.schedules[-1])

    def _note_of_schedule(self, row: Row, seen: Seen) -> None:
        what = row['what']
        if what in ('choices', 'lost', 'failed'):
            seen.choices = [(str(key), str(at)) for key, at in row['choices']]
            seen.rounds = list(map(int, row['rounds']))
        if what == 'choices':
            seen.choosable = [
                [(str(key), str(at)) for key, at in each] for each in row['choosable']
            ]
            seen.begins = int(row['begins'])
        elif what == 'done':
            seen.is_done, seen.seconds = True, float(row['at']) - seen.begun
        elif what == 'lost':
            self._add(seen, lost_update(row))
        elif what == 'failed':
            self._add(seen, exception(row))
        elif what == 'looks':
            seen.samples.append(sample_of(self._pid, row))
            self._add(seen, hang(seen.samples))
        elif what == 'stands':
            self._add(seen, stands(seen.samples))

    def _add(self, seen: Seen, failure: Failure | None) -> None:
        if failure is not None and not any(failure.is_like(each) for each in seen.failures):
            seen.failures.append(failure)
            # Nothing goes on after that.
            hangs = failure.kind in (Kind.HANG, Kind.STANDS)
            self._is_over = self._is_over or hangs or self._until(failure)
