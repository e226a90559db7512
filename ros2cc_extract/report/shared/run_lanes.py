"""A run cut into lanes: which process was where between which steps, for timelines."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.verify.results.evidence import Evidence, Moment


@dataclass(frozen=True)
class Stay:
    """
    A process in one location.

    :param since: number of the step that led there; 0 is the start.
    :param until: number of the step that led away, or one more than the last step.
    :param callback: what it does there, for a thread or the executor.
    :param is_rest: true in the location of the start.
    """

    location: str
    since: int
    until: int
    callback: str | None
    is_rest: bool


@dataclass(frozen=True)
class Lane:
    """The stays of one process, without a gap."""

    process: str
    stays: tuple[Stay, ...]


def lanes_of(run: Evidence, callbacks: Iterable[str]) -> tuple[Lane, ...]:
    """
    Cut a run into one lane per process that acts or moves, in the order of the model.

    :param callbacks: names of the unit's callbacks, to be found in the sentences.
    """
    known = set(callbacks)
    lanes = [Lane(process, tuple(stays_of(run, process, known))) for process in run.start]
    acting = {s.lane for moment in run.moments for s in moment.sentences}
    return tuple(lane for lane in lanes if lane.process in acting or len(lane.stays) > 1)


def stays_of(run: Evidence, process: str, callbacks: set[str]) -> Iterator[Stay]:
    """Cut a run into the stays of one process."""
    rest = location = run.start[process]
    since, callback = 0, None
    for moment in run.moments:
        changed = moment.changes.get(process)
        if isinstance(changed, str) and changed != location:
            yield Stay(location, since, moment.number, callback, location == rest)
            location, since = changed, moment.number
            callback = None if location == rest else _callback_of(moment, process, callbacks)
    yield Stay(location, since, len(run.moments) + 1, callback, location == rest)


def _callback_of(moment: Moment, process: str, callbacks: set[str]) -> str | None:
    """The callback named together with the process, or by it."""
    for sentence in moment.sentences:
        event = sentence.event
        words = event.mentions if event is not None else re.findall(r'\w+', sentence.text)
        if process in words or sentence.lane == process:
            named = [word for word in words if word in callbacks and word != process]
            if named:
                return str(named[0])
    return None
